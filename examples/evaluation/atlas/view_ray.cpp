#include "view_ray.hpp"

#include <gnomon/moments/bounds.h>
#include <gnomon/moments/hamburger4.h>
#include <gnomon/moments/hamburger6.h>
#include <gnomon/storage/formats.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>

namespace gnomon::evaluation {

namespace {

// The channels of a row.
template <storage_format Format> format_channels<Format> kept(std::span<const layer> row)
{
    using numbers = std::array<float, channel_count<Format>>;
    const auto stored = [](const format_channels<Format>& c) {
        return std::bit_cast<numbers>(Format::decode(Format::encode(c)));
    };
    std::array<double, channel_count<Format>> sum{};
    for (const layer& l : row) {
        const numbers texel = stored(Format::from_depth(l.depth));
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += double(l.weight) * double(texel[k]);
    }
    numbers mean;
    for (std::size_t k = 0; k < sum.size(); ++k) mean[k] = float(sum[k]);
    return std::bit_cast<format_channels<Format>>(stored(std::bit_cast<format_channels<Format>>(mean)));
}

template <storage_format Format> row_format moments_of(const char* label)
{
    return {std::string(Format::id) + "_row", label, [](std::span<const layer> row, float z_f, float overestimation) {
                const auto factor = Format::filtered_factor(kept<Format>(row));
                if constexpr (channel_count<Format> == 4)
                    return double(bounds_intensity(hamburger4_bounds(factor, z_f), overestimation));
                else return double(bounds_intensity(hamburger6_bounds(factor, z_f), overestimation));
            }};
}

double series_intensity(std::span<const layer> row, float z_f, float)
{
    const convolution_settings<float> settings{16, 0, 0, 0.9375f};
    const auto c = std::bit_cast<std::array<float, 32>>(kept<convolution_unorm8>(row));
    convolution_sum<float> sum = convolution_begin(z_f, settings);
    for (std::size_t k = 0; k < 16; ++k)
        sum = convolution_add(sum, 2 * c[2 * k] - 1, 2 * c[2 * k + 1] - 1, convolution_weight(float(k + 1), settings));
    return double(convolution_end(sum));
}

} // namespace

std::vector<row_format> row_formats()
{
    return {{"convolution_unorm8_row", "CSM 256 bit", series_intensity},
            moments_of<moments4_unorm16>("MSM 64 bit"),
            moments_of<moments4_float>("MSM 128 bit"),
            moments_of<moments6_unorm10>("MSM6 60 bit"),
            moments_of<moments6_unorm16>("MSM6 96 bit"),
            moments_of<moments6_float>("MSM6 192 bit")};
}

std::vector<sweep_layer> layers_of_rows(const std::function<double(const row_intensity&, double x, double y)>& error)
{
    std::vector<sweep_layer> result;
    for (const row_format& f : row_formats())
        result.push_back({f.id, f.label, [error, f](double x, double y) { return error(f.intensity, x, y); }});
    return result;
}

double error_of_row(const row_intensity& intensity, std::span<const layer> row, float z_f, float overestimation)
{
    return std::abs(intensity(row, z_f, overestimation) - exact_intensity(row, z_f));
}

} // namespace gnomon::evaluation
