// Means over discs in a summed-area table, by three look-ups of rectangles (soft/disc.h).
#ifndef GNOMON_PASSES_SUMMED_DISC_HPP
#define GNOMON_PASSES_SUMMED_DISC_HPP

#include "../soft/disc.h"
#include "summed_area.hpp"

GNOMON_NAMESPACE_BEGIN

/// The mean channels of a table over the disc, or ellipse, that a rectangle bounds, as far as it lies in the map. Each of
/// its three rectangles shrinks where it touches more than most_texels. Reads 48 texels. The border where nothing is left.
template <summed_table Table>
format_channels<Table> disc_average(map_view<const format_texel<Table>> table, std::size_t most_texels,
                                    const summed_area_rectangle<float>& bounds)
{
    std::array<float, channel_count<Table>> sum{};
    float whole = 0;
    for (const float index : {0.0f, 1.0f, 2.0f}) {
        const summed_area_rectangle<float> r = disc_rectangle(bounds, index);
        const summed_area_rectangle<float> inside =
            summed_area_clip(r, float(table.width), float(table.height), float(most_texels));
        const float area = (inside.x1 - inside.x0) * (inside.y1 - inside.y0);
        const auto mean = gnomon_bit_cast<decltype(sum)>(rectangle_average<Table>(table, most_texels, r));
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += area * mean[k];
        whole += area;
    }
    if (!(whole > 0)) return rectangle_average<Table>(table, most_texels, {0, 0, 0, 0});
    for (float& x : sum) x /= whole;
    return gnomon_bit_cast<format_channels<Table>>(sum);
}

GNOMON_NAMESPACE_END
#endif
