// Moment shadow maps of motion from resolved ranges: the moments over time of what each texel sees, in closed form
// (motion/range/range_moments.h), in any storage format of four moments. Blur, mips and look-ups are those of any moment
// shadow map.
#ifndef GNOMON_PASSES_RANGE_MOMENTS_HPP
#define GNOMON_PASSES_RANGE_MOMENTS_HPP

#include "../../motion/range/range_moments.h"
#include "../map_view.hpp"
#include "taps.hpp"

#include <cstddef>

GNOMON_NAMESPACE_BEGIN

/// Fill rows of a map with the moments of the lists of a map of resolved ranges. Times without a surface have depth 1.
/// Error: range_moments4_end, and that of the format.
template <texel_format Format, class T>
void fill_range_moments(const range_map<T>& from, map_view<format_texel<Format>> target, row_range rows)
{
    check_shape(from, "fill_range_moments");
    expect_map("fill_range_moments", "target", target);
    GNOMON_EXPECTS(target.width == from.width,
                   mismatch("fill_range_moments", "target.width", target.width, "from.width", from.width));
    GNOMON_EXPECTS(target.height == from.height,
                   mismatch("fill_range_moments", "target.height", target.height, "from.height", from.height));
    expect_rows("fill_range_moments", target, rows);
    for (std::size_t y = rows.first; y < rows.last; ++y)
        for (std::size_t x = 0; x < from.width; ++x) {
            range_moments4<T> state = range_moments4_begin(T(1));
            detail::for_each_counted(from(x, y), T(range_nothing),
                                     [&](const depth_time_range<T>& r) { state = range_moments4_add(state, r); });
            const moments4<T> b = range_moments4_end(state);
            target(x, y) = Format::encode(
                Format::from_moments(moments4<float>{float(b.b1), float(b.b2), float(b.b3), float(b.b4)}));
        }
}

template <texel_format Format, class T>
void fill_range_moments(const range_map<T>& from, map_view<format_texel<Format>> target)
{
    fill_range_moments<Format>(from, target, {0, target.height});
}

GNOMON_NAMESPACE_END
#endif
