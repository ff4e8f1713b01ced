// Lists without their backdrops. A backdrop is there for the whole of the shutter, behind all else, as the ground often
// is. It shadows nothing that its texel sees, and where nothing is in front of it no list remains. Keep it where
// receivers come from outside of the map's scene: they may be behind it, as may be a receiver beside the backdrop's
// border that only part of the texel sees.
#ifndef GNOMON_PASSES_BACKDROP_HPP
#define GNOMON_PASSES_BACKDROP_HPP

#include "../motion/range.h"

#include <algorithm>
#include <optional>
#include <span>

namespace gnomon {

/// Ranges as they come, less the farthest that lasts from 0 to 1, which waits: whether it is a backdrop is known at the
/// end. Whoever drops hidden ranges meanwhile must ask every range through this filter first. A hidden backdrop, once
/// dropped, would leave the lowest caster in its place.
template <class T> class backdrop_filter {
  public:
    /// What goes into the list now that r has come: r, or what has waited until now.
    std::optional<depth_time_range<T>> add(const depth_time_range<T>& r)
    {
        if (r.t0 <= 0 && 1 <= r.t1 && lies_behind(r)) {
            const std::optional<depth_time_range<T>> before = waiting_;
            if (before) deepest_other_ = std::max(deepest_other_, farther_end(*before));
            waiting_ = r;
            return before;
        }
        if (r.t0 <= r.t1) deepest_other_ = std::max(deepest_other_, farther_end(r));
        return r;
    }

    /// The farthest that lasts from 0 to 1.
    const std::optional<depth_time_range<T>>& waiting() const { return waiting_; }

    /// Whether that is behind all others that have come.
    bool is_backdrop() const { return waiting_ && deepest_other_ <= nearer_end(*waiting_); }

  private:
    static T nearer_end(const depth_time_range<T>& r) { return std::min(r.z0, r.z1); }
    static T farther_end(const depth_time_range<T>& r) { return std::max(r.z0, r.z1); }

    /// Whether r takes the place of what waits; a NaN never does. Of equal ones the lower id waits.
    bool lies_behind(const depth_time_range<T>& r) const
    {
        if (!waiting_) return r.z0 == r.z0 && r.z1 == r.z1;
        const T near = nearer_end(r), far = farther_end(r), near_of = nearer_end(*waiting_),
                far_of = farther_end(*waiting_);
        if (near != near_of) return near > near_of;
        return far != far_of ? far > far_of : r.id < waiting_->id;
    }

    std::optional<depth_time_range<T>> waiting_;
    T deepest_other_ = T(-1); // depths are in [-1, 1]
};

/// A list without its backdrop, in place, in its order.
template <class T> std::span<depth_time_range<T>> without_backdrop(std::span<depth_time_range<T>> list)
{
    backdrop_filter<T> filter;
    for (const depth_time_range<T>& r : list) filter.add(r);
    if (!filter.is_backdrop()) return list;
    const depth_time_range<T> backdrop = *filter.waiting();
    const auto found = std::ranges::find_if(list, [&](const depth_time_range<T>& r) {
        return r.id == backdrop.id && r.t0 == backdrop.t0 && r.t1 == backdrop.t1 && r.z0 == backdrop.z0 &&
               r.z1 == backdrop.z1;
    });
    std::copy(found + 1, list.end(), found);
    return list.first(list.size() - 1);
}

} // namespace gnomon
#endif
