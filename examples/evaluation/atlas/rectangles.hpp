// Rectangles of summed-area tables over few surfaces: the mean channels that a look-up finds, and the exact mean depth of
// blockers.
#pragma once

#include "region.hpp"

#include <gnomon/soft/summed_area.h>
#include <gnomon/storage/summed_texel.hpp>

#include <array>
#include <bit>
#include <cstddef>
#include <span>

namespace gnomon::evaluation {

// The mean channels of a rectangle over a region, in a table for most_texels. Sums are those of integers: exact.
template <summed_table Table>
format_channels<Table> rectangle_over(std::span<const layer> region, double texels, float most_texels)
{
    const float scale = summed_area_scale(most_texels);
    std::array<double, sizeof(format_channels<Table>) / sizeof(float)> sums{};
    for (const layer& l : region) {
        const auto codes =
            std::bit_cast<std::array<float, sums.size()>>(Table::codes(Table::from_depth(l.depth), scale));
        for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += double(l.weight) * texels * double(codes[k]);
    }
    std::array<float, sums.size()> rounded;
    for (std::size_t k = 0; k < sums.size(); ++k) rounded[k] = float(sums[k]);
    return Table::mean(std::bit_cast<format_channels<Table>>(rounded), float(texels), scale);
}

// Mean depth, by weight, of the surfaces in front of depth z_f; z_f where there is none.
double exact_blocker(std::span<const layer> region, float z_f);

} // namespace gnomon::evaluation
