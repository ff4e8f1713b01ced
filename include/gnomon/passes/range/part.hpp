// Neighbouring ranges parted. Triangles with widened edges (motion/triangle/edge_widening.h) overlap for a brief time
// where one follows the other. Short lists would store that time as ranges of its own, and merge others for lack of
// room.
#ifndef GNOMON_PASSES_RANGE_PART_HPP
#define GNOMON_PASSES_RANGE_PART_HPP

#include "../../motion/range/range.h"
#include "../../portable/cpp_only.h"

#include <span>

GNOMON_NAMESPACE_BEGIN

/// The longest time for which neighbours overlap, and the largest distance between them in that time.
template <class T> inline constexpr T neighbours_overlap = T(0x1p-14);
template <class T> inline constexpr T neighbours_distance = T(0x1p-13);

/// End every range of a list, in place, at the begin of another range that follows closely: one that begins at nearly
/// the same depth, at most neighbours_overlap before the first range ends, and ends later. Every time that was covered
/// stays covered; within the overlap the nearer of the two ranges may be lost.
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

GNOMON_NAMESPACE_END
#endif
