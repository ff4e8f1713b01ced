// Lists without their backdrops. A backdrop is there for the whole of the shutter, behind all else, as the ground often
// is. It shadows nothing that its texel sees, and where nothing is in front of it no list remains. Keep it where
// receivers come from outside of the map's scene: they may be behind it, as may be a receiver beside the backdrop's
// border that only part of the texel sees.
#ifndef GNOMON_PASSES_RANGE_BACKDROP_HPP
#define GNOMON_PASSES_RANGE_BACKDROP_HPP

#include "../../motion/range/range.h"
#include "../../portable/cpp_only.h"

#include <algorithm>
#include <span>

namespace gnomon {

/// Ranges as they come, less the farthest that lasts from 0 to 1, which waits: whether it is a backdrop is known at the
/// end. Whoever drops hidden ranges meanwhile must ask every range through this filter first. A hidden backdrop, once
/// dropped, would leave the lowest caster in its place. Of one list, or of one in each lane of a pack.
template <class Real> class backdrop_filter {
  public:
    using range = depth_time_range<Real>;

    /// Takes r, and returns the range that goes into the list instead: r, or what has waited until now, which is empty
    /// at first.
    GNOMON_INLINE range add(const range& r)
    {
        const auto some = r.t0 <= r.t1 && r.z0 == r.z0 && r.z1 == r.z1;
        const auto waits = some && r.t0 <= Real(0) && Real(1) <= r.t1 && (!waiting_some() || is_behind(r, waiting_));
        const range listed = range_select(waits, waiting_, r);
        waiting_ = range_select(waits, r, waiting_);
        const auto counts = listed.t0 <= listed.t1 && listed.z0 == listed.z0 && listed.z1 == listed.z1;
        deepest_ = gnomon_select(counts, gnomon_max(deepest_, farther_end(listed)), deepest_);
        return listed;
    }

    /// The farthest that lasts from 0 to 1; an empty one where there is none.
    const range& waiting() const { return waiting_; }

    /// True where that is behind all others that have come.
    auto is_backdrop() const { return waiting_some() && deepest_ <= nearer_end(waiting_); }

    /// The range that has waited in vain, since it is not behind all else, and belongs into the list; else an empty
    /// one. Ask after the last range.
    range rest() const { return range_select(is_backdrop(), range_empty(Real(range_nothing)), waiting_); }

  private:
    static Real nearer_end(const range& r) { return gnomon_min(r.z0, r.z1); }
    static Real farther_end(const range& r) { return gnomon_max(r.z0, r.z1); }

    auto waiting_some() const { return waiting_.t0 < waiting_.t1; }

    /// By the nearer end, then by the farther one; of equal ones the lower id waits.
    static auto is_behind(const range& a, const range& b)
    {
        const auto same_near = nearer_end(a) == nearer_end(b), same_far = farther_end(a) == farther_end(b);
        return nearer_end(b) < nearer_end(a) ||
               (same_near && (farther_end(b) < farther_end(a) || (same_far && a.id < b.id)));
    }

    range waiting_ = range_empty(Real(range_nothing));
    Real deepest_ = Real(-1); // of all others; depths are in [-1, 1]
};

/// A list without its backdrop, in place, in its order.
template <class T> std::span<depth_time_range<T>> without_backdrop(std::span<depth_time_range<T>> list)
{
    backdrop_filter<T> filter;
    for (const depth_time_range<T>& r : list) filter.add(r);
    if (!filter.is_backdrop()) return list;
    const depth_time_range<T> backdrop = filter.waiting();
    const auto found = std::ranges::find_if(list, [&](const depth_time_range<T>& r) {
        return r.id == backdrop.id && r.t0 == backdrop.t0 && r.t1 == backdrop.t1 && r.z0 == backdrop.z0 &&
               r.z1 == backdrop.z1;
    });
    std::copy(found + 1, list.end(), found);
    return list.first(list.size() - 1);
}

} // namespace gnomon
#endif
