// Shadow intensity at one instant in maps of line samples (motion/receiver/line_sample.h). A map of lines is a map of
// ranges, as of look_up.hpp, with places on the texel's line for times. Outside of a map everything is lit.
#ifndef GNOMON_PASSES_RANGE_LINES_HPP
#define GNOMON_PASSES_RANGE_LINES_HPP

#include "../../motion/range/range.h"
#include "../../motion/receiver/line_sample.h"
#include "../../portable/cpp_only.h"

#include <algorithm>
#include <cstddef>

GNOMON_NAMESPACE_BEGIN

/// A receiver at texel position (x, y), of depth z, less the depth bias.
template <class T> struct line_receiver {
    T x, y, z, id;
};

/// Direction of a map's lines.
enum class line_axis { x, y };

namespace detail {

/// Intensities at the receiver's place on the two lines beside it, and the share of the distance between these lines.
template <class T> struct neighbour_lines {
    T first, second, share;

    T between() const { return first * (1 - share) + second * share; }
};

template <class Map, class T>
neighbour_lines<T> neighbours_of(const Map& map, line_axis axis, const line_receiver<T>& r)
{
    const bool rows = axis == line_axis::x;
    const line_sample_place<T> at = line_sample_place_of(rows ? r.x : r.y);
    const T across = (rows ? r.y : r.x) - T(0.5), line = texel_below(across);
    const auto hidden = [&](T beside) {
        const T column = rows ? at.texel : beside, row = rows ? beside : at.texel;
        T shadow = 0;
        if (!(column >= 0 && row >= 0 && column < T(map.width) && row < T(map.height))) return shadow;
        for (const depth_time_range<T>& range : map[map.texel(map.width, std::size_t(column), std::size_t(row))])
            shadow = (std::max)(shadow, range_intensity(range, at.place, r.z, r.id, T(0)));
        return shadow;
    };
    return {hidden(line), hidden(line + 1), saturate_or_zero(across - line)};
}

} // namespace detail

/// Shadow intensity in [0, 1] by lines of one direction: exact along them, interpolated between the two beside the receiver.
/// NaN: 0, lit.
template <class Map, class T> T line_intensity(const Map& map, line_axis axis, const line_receiver<T>& receiver)
{
    return saturate_or_zero(detail::neighbours_of(map, axis, receiver).between());
}

/// Shadow intensity in [0, 1] by lines along x and lines along y of the same instant. Lines along y are read only where
/// those along x disagree.
/// NaN: 0, lit.
/// Error: that of line_sample_intensity.
template <class Map, class T>
T crossed_intensity(const Map& along_x, const Map& along_y, const line_receiver<T>& receiver)
{
    const auto rows = detail::neighbours_of(along_x, line_axis::x, receiver);
    if (rows.first == rows.second) return rows.first;
    const auto columns = detail::neighbours_of(along_y, line_axis::y, receiver);
    return line_sample_intensity(rows.first, rows.second, columns.first, columns.second, columns.share, rows.share);
}

GNOMON_NAMESPACE_END
#endif
