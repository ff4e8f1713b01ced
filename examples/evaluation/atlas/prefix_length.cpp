// The length of a row: prefix averages by sums in float, as a shader has them, and by the library's pass.
#include "region.hpp"
#include "sweep.hpp"

#include <gnomon/moments/bounds.h>
#include <gnomon/moments/hamburger4.h>
#include <gnomon/moments/hamburger6.h>
#include <gnomon/passes/transmittance_prefix.hpp>
#include <gnomon/storage/formats.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace gnomon::evaluation::prefix_length {

namespace {

// The last average of a row of texels.
template <storage_format Format> using last_average = format_channels<Format> (*)(std::vector<format_texel<Format>>&);

template <storage_format Format> format_channels<Format> by_pass(std::vector<format_texel<Format>>& row)
{
    const std::array rows{rectified_row{}};
    transmittance_prefix<Format>({row, row.size(), 1}, rows, {0, 1});
    return Format::decode(row.back());
}

// A running mean in float.
template <storage_format Format> format_channels<Format> by_float(std::vector<format_texel<Format>>& row)
{
    channel_array<Format> mean = load_channels<Format>(row[0]);
    float g = 1;
    for (const format_texel<Format>& texel : row) {
        if (&texel == &row[0]) continue;
        g = transmittance_weight_next(g, 1.0f);
        const channel_array<Format> c = load_channels<Format>(texel);
        for (std::size_t k = 0; k < c.size(); ++k) mean[k] += g * (c[k] - mean[k]);
    }
    return Format::decode(store_channels<Format>(mean));
}

// The most by which bounds on the shadow of a ray are broken, over rays on and between two surfaces that shadow three of
// four texels and the fourth, in several places of the range of depth.
template <storage_format Format> double error(double texels, double distance, last_average<Format> average)
{
    constexpr int places = 6;
    double worst = 0;
    for (int i = 0; i < places; ++i) {
        const auto first = float(-0.95 + (1.9 - distance) * (i + 0.5) / places);
        const float second = first + float(distance);
        std::vector<format_texel<Format>> row;
        for (int u = 0; u < std::lround(texels); ++u)
            row.push_back(Format::encode(Format::from_depth(u % 4 != 3 ? first : second)));
        const auto factor = Format::filtered_factor(average(row));
        const auto bounds = [&](float z_f) {
            if constexpr (channel_count<Format> == 4) return hamburger4_bounds(factor, z_f);
            else return hamburger6_bounds(factor, z_f);
        };
        worst = std::max({worst, double(bounds(first).lower), 0.75 - double(bounds(first).upper),
                          double(bounds(second).lower) - 0.75, 1 - double(bounds(second).upper)});
    }
    return worst;
}

template <storage_format Format>
sweep_layer shown(const char* id, const std::string& label, last_average<Format> average)
{
    return {std::string(Format::id) + id, label,
            [average](double texels, double distance) { return error<Format>(texels, distance, average); }};
}

std::vector<sweep_layer> layers()
{
    return {shown<moments4_unorm16>("_running", "MSM 64 bit, mean in float", by_float<moments4_unorm16>),
            shown<moments4_unorm16>("_pass", "MSM 64 bit, by the pass", by_pass<moments4_unorm16>),
            shown<moments4_float>("_running", "MSM 128 bit, mean in float", by_float<moments4_float>),
            shown<moments4_float>("_pass", "MSM 128 bit, by the pass", by_pass<moments4_float>),
            shown<moments6_float>("_running", "MSM6 192 bit, mean in float", by_float<moments6_float>),
            shown<moments6_float>("_pass", "MSM6 192 bit, by the pass", by_pass<moments6_float>)};
}

const registered<sweep> entry{sweep{
    .id = "prefix_length",
    .label = "Length of a row",
    .order = 200,
    .text =
        "Three of four texels of a row are shadowed by a surface, the fourth by one behind it. Rays are on either. The "
        "average of the row is a running mean in float, or that of the library's pass. Each point is the worst of "
        "six depths.",
    .x = {"texels", "number of texels of a row", scale::log, 16, 4096, 9},
    .y = {"distance", "distance of the surfaces", scale::log, 1e-4, 0.1, 16},
    .error_label = "error of a bound",
    .threshold = 0.02,
    .layers = layers}};

} // namespace

} // namespace gnomon::evaluation::prefix_length
