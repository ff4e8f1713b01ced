// Mip levels of a prefix map: a texel of a level is the mean of averages that end at different distances from the eye. It
// stands for a ray that ends in the middle of them only where averages change little.
#include "sweep.hpp"

#include <gnomon/passes/mips.hpp>
#include <gnomon/passes/rectified_look_up.hpp>
#include <gnomon/passes/transmittance_prefix.hpp>
#include <gnomon/storage/moments4.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace gnomon::evaluation::mip_footprint {

namespace {

constexpr std::size_t columns = 1024;
using format = moments4_float;

// The error at the end of a ray that is in shadow up to a column and lit from there on. The first moment of depths -1
// and 1 is that of the shares in shadow and in light.
double error(double depth, float end, std::size_t lit_from, float level)
{
    const rectified_frame frame{float(columns), 0, 1, rectified_depth::polar};
    std::array<rectified_row, 1> rows;
    rows[0].optical_depth = float(depth / columns);
    rows[0].factor = std::exp(-rows[0].optical_depth);
    std::vector<format::texel> texels(mip_texels(columns, 1));
    for (std::size_t u = 0; u < columns; ++u)
        texels[u] = format::encode(format::from_depth(u < lit_from ? -1.0f : 1.0f));
    const mip_view<format::texel> mips{texels, columns, 1};
    transmittance_prefix<format>(mips.level(0), rows, {0, 1});
    build_mips<format>(mips);
    const auto c = rectified_channels<format>(mips, frame, rows, {end, 0.5f, 0}, level);
    const auto weight = [&](double to) { return depth > 0 ? -std::expm1(-depth * to / columns) : to; };
    const double exact = (weight(double(end)) - weight(double(lit_from))) / weight(double(end));
    return std::abs((double(c.c1) + 1) / 2 - exact);
}

std::vector<sweep_layer> layers()
{
    std::vector<sweep_layer> result;
    for (const int depth : {0, 4, 16})
        result.push_back({"row_depth_" + std::to_string(depth), "optical depth of the row: " + std::to_string(depth),
                          [=](double end, double level) {
                              double worst = 0;
                              for (const double share : {0.25, 0.5, 0.75})
                                  worst = std::max(worst, error(depth, float(end),
                                                                std::size_t(std::lround(share * end)), float(level)));
                              return worst;
                          }});
    return result;
}

const registered<sweep> entry{sweep{
    .id = "mip_footprint",
    .label = "Footprint of a pixel",
    .order = 210,
    .text = "A ray ends some texels from the eye, in a row of 1024. A quarter, half or three quarters of it are in "
            "shadow at first. It is read from a mip level, whose texels are as wide as the footprint of the pixel. The "
            "errors are those of the filter alone: the distribution of depths is exact.",
    .x = {"end", "end of the ray in texels from the eye", scale::log, 4, 1000, 24},
    .y = {"level", "mip level", scale::linear, 0, 8, 17},
    .error_label = "error",
    .threshold = 0.1,
    .layers = layers}};

} // namespace

} // namespace gnomon::evaluation::mip_footprint
