// Lists without their backdrops. A backdrop lasts for the whole shutter, behind everything else, as the ground often
// does. It shadows nothing that its texel sees, and where nothing is in front of it no list remains. Keep backdrops if
// receivers are not part of the map's scene, since they may lie behind a backdrop. A receiver beside the border of a
// backdrop that only part of the texel sees may lie behind it, too.
#ifndef GNOMON_PASSES_RANGE_BACKDROP_HPP
#define GNOMON_PASSES_RANGE_BACKDROP_HPP

#include "../../motion/range/range.h"
#include "../../portable/cpp_only.h"

#include <algorithm>
#include <span>

GNOMON_NAMESPACE_BEGIN

/// A filter that withholds the farthest of those ranges that last from 0 to 1: only after the last range is it known
/// whether that one is a backdrop. If occluded ranges are dropped at the same time, every range must pass this filter
/// first: after the loss of an occluded backdrop the filter would take the lowest caster for the backdrop. Real is a
/// scalar for one list, or a pack for a list in each lane.
template <class Real> class backdrop_filter {
  public:
    using range = depth_time_range<Real>;

    /// Add r, and return the range to insert into the list instead: r itself, or the range that was withheld until now,
    /// which is empty at first.
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

    /// The farthest range that lasts from 0 to 1; an empty one if there is none.
    const range& waiting() const { return waiting_; }

    /// True if the withheld range is behind all others that were added.
    auto is_backdrop() const { return waiting_some() && deepest_ <= nearer_end(waiting_); }

    /// The withheld range if it is no backdrop and belongs into the list, else an empty range. Call after the last
    /// range.
    range rest() const { return range_select(is_backdrop(), range_empty(Real(range_nothing)), waiting_); }

  private:
    static Real nearer_end(const range& r) { return gnomon_min(r.z0, r.z1); }
    static Real farther_end(const range& r) { return gnomon_max(r.z0, r.z1); }

    auto waiting_some() const { return waiting_.t0 < waiting_.t1; }

    /// True if a is farther than b, by the nearer end, then by the farther end; of equal ranges the one with the lower
    /// id.
    static auto is_behind(const range& a, const range& b)
    {
        const auto same_near = nearer_end(a) == nearer_end(b), same_far = farther_end(a) == farther_end(b);
        return nearer_end(b) < nearer_end(a) ||
               (same_near && (farther_end(b) < farther_end(a) || (same_far && a.id < b.id)));
    }

    range waiting_ = range_empty(Real(range_nothing));
    Real deepest_ = Real(-1); // of all others; depths are in [-1, 1]
};

/// Remove the backdrop of a list, in place; the order of the others stays. Return the list that remains.
template <class T> std::span<depth_time_range<T>> without_backdrop(std::span<depth_time_range<T>> list)
{
    backdrop_filter<T> filter;
    for (const depth_time_range<T>& r : list) filter.add(r);
    if (!filter.is_backdrop()) return list;
    const depth_time_range<T> backdrop = filter.waiting();
    const auto found = std::find_if(list.begin(), list.end(), [&](const depth_time_range<T>& r) {
        return r.id == backdrop.id && r.t0 == backdrop.t0 && r.t1 == backdrop.t1 && r.z0 == backdrop.z0 &&
               r.z1 == backdrop.z1;
    });
    std::copy(found + 1, list.end(), found);
    return list.first(list.size() - 1);
}

GNOMON_NAMESPACE_END
#endif
