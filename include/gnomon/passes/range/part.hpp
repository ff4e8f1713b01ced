// Neighbours parted: triangles whose edges are widened (motion/triangle/edge_widening.h) overlap for a moment where one follows
// the other. Lists of few ranges would spend room on that moment, and merge for want of room.
#ifndef GNOMON_PASSES_RANGE_PART_HPP
#define GNOMON_PASSES_RANGE_PART_HPP

#include "../../motion/range/range.h"
#include "../../portable/cpp_only.h"

#include <span>

namespace gnomon {

/// The longest time for which neighbours overlap, and the largest distance between them then.
template <class T> inline constexpr T neighbours_overlap = T(0x1p-14);
template <class T> inline constexpr T neighbours_distance = T(0x1p-13);

/// Ends every range of a list at the begin of another one that follows it so closely: which begins at nearly its depth,
/// neighbours_overlap before it ends at most, and lasts longer. In place. All times keep a range; for those moments the
/// nearer of the two may be gone.
template <class T> void part_neighbours(std::span<depth_time_range<T>> list)
{
    for (depth_time_range<T>& r : list)
        for (const depth_time_range<T>& next : list) {
            const bool follows = r.t0 < next.t0 && next.t0 < r.t1 && r.t1 < next.t1;
            if (!follows || r.t1 - next.t0 > neighbours_overlap<T>) continue;
            const T depth = range_depth(r, next.t0);
            if (!(gnomon_abs(depth - next.z0) <= neighbours_distance<T>)) continue;
            r.t1 = next.t0, r.z1 = depth;
        }
}

} // namespace gnomon
#endif
