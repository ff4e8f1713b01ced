// Resampling of a directional light's shadow map into rectified coordinates (scattering/rectified.h), in which each view ray is
// a row and a depth (Peters et al. 2017, Sec. 5.1.1 and 5.2). A texel at radius r of a row of azimuth phi is the light ray that
// crosses the map at eye + r (cos phi, sin phi). The depth of its occluder there becomes the polar angle atan2(r, z), or the
// cosine of that, and a depth in the row's range.
//
//     rectify           the depth of one texel of the map, as it is: aliases
//     rectify_filtered  16 texels of the map, weighted by a cubic B-spline over the footprint of the texel: an exact filter
//     rectify_moments   a trilinear sample of a map of moments, whose distribution of two depths is mapped (Alg. 2)
//     rectify_depths    the depth of one texel, as a number
//
// Depths of the map on the far plane and beyond, and what lies beside the map, shadow nothing. For several directional lights
// make a map for each, and add up their light.
//
// No allocation; threads may take different bands of rows. Each pass rounds to the format once.
#ifndef GNOMON_PASSES_RECTIFY_HPP
#define GNOMON_PASSES_RECTIFY_HPP

#include "../moments/two_point.h"
#include "../storage/moments4.hpp"
#include "look_up.hpp"
#include "rectified_map.hpp"

#include <algorithm>
#include <cmath>

GNOMON_NAMESPACE_BEGIN

namespace detail {

/// The texels of a row that are rectified at once, and a number for each of them. Loops over these become vectors.
inline constexpr std::size_t rectify_texels = 64;
using rectify_lanes = std::array<float, rectify_texels>;

/// Signed depths in a row's range of occluders at a radius, from their signed depths in the map.
struct rectified_mapping {
    float eye, length; // the eye's depth in the map, and length for a unit of depth
    rectified_range<float> range;
    float far_plane; // depths that are not less are no occluders

    rectified_mapping(const light_map& light, const rectified_row& row, float from = 1)
        : eye(light.z), length(1 / light.depths), range(row.range), far_plane(from)
    {}

    /// Replace depths of the map by depths of occluders in the row's range: 1 for a depth that is no occluder or NaN. Compilers
    /// make vectors of each of these loops, and would not of a single one.
    template <rectified_depth measure> void apply(const rectify_lanes& radius, rectify_lanes& depth) const
    {
        constexpr std::size_t count = rectify_texels;
        const rectified_mapping map = *this;
        rectify_lanes z;
        for (std::size_t i = 0; i < count; ++i) z[i] = (gnomon_max(depth[i], -1.0f) - map.eye) * map.length;
        if constexpr (measure == rectified_depth::polar) {
            for (std::size_t i = 0; i < count; ++i) z[i] = polynomial_atan2(radius[i], z[i]);
            for (std::size_t i = 0; i < count; ++i) z[i] = rectified_polar_depth(z[i], map.range);
        } else {
            for (std::size_t i = 0; i < count; ++i) z[i] = rectified_cosine(radius[i], 0.0f, z[i]);
            for (std::size_t i = 0; i < count; ++i) z[i] = rectified_cosine_depth(z[i], map.range);
        }
        for (std::size_t i = 0; i < count; ++i)
            depth[i] = gnomon_select(depth[i] < map.far_plane, gnomon_select(z[i] <= 1, z[i], 1.0f), 1.0f);
    }
};

/// The texels of a row: radii, and places in the map.
struct rectified_places {
    float x, y, dx, dy, side_x, side_y; // the eye, and the way in the map for a unit of radius, and of length beside it
    float step;

    rectified_places(const light_map& light, const rectified_frame& frame, const rectified_row& row,
                     std::size_t columns)
        : x(light.x),
          y(light.y),
          dx(row.cosine * light.texels_x),
          dy(row.sine * light.texels_y),
          side_x((std::abs)(row.sine * light.texels_x)),
          side_y((std::abs)(row.cosine * light.texels_y)),
          step(rectified_radius_step(frame, columns))
    {}
    [[nodiscard]] float radius(std::size_t u) const { return (float(u) + 0.5f) * step; }
};

/// Radii of texels of a row from a first one on, and their places in the map.
struct rectified_block {
    rectify_lanes radius, x, y;

    rectified_block(const rectified_places& at, std::size_t first)
    {
        const rectified_places a = at;
        for (std::size_t i = 0; i < rectify_texels; ++i) {
            radius[i] = a.radius(first) + float(i) * a.step;
            x[i] = a.x + radius[i] * a.dx;
            y[i] = a.y + radius[i] * a.dy;
        }
    }
};

/// Four texels along one axis of a map, for each place, and their weights under a cubic B-spline over texels as wide as spacing.
struct spline_texels {
    std::array<rectify_lanes, 4> at, weight;

    spline_texels(const rectify_lanes& place, const rectify_lanes& spacing)
    {
        for (std::size_t i = 0; i < rectify_texels; ++i) {
            const float x = place[i] / spacing[i] - 0.5f, whole = std::floor(x), u = x - whole, v = 1 - u;
            weight[0][i] = v * v * v / 6;
            weight[1][i] = ((3 * u - 6) * (u * u) + 4) / 6;
            weight[2][i] = ((3 * v - 6) * (v * v) + 4) / 6;
            weight[3][i] = u * u * u / 6;
            for (std::size_t k = 0; k < 4; ++k) at[k][i] = (whole + (float(k) - 0.5f)) * spacing[i];
        }
    }
};

/// Fill in the depth of the map at each place, that of its texel, or the far plane beside the map.
inline void fetch_depths(map_view<const float> depths, const rectify_lanes& x, const rectify_lanes& y,
                         std::size_t count, rectify_lanes& depth)
{
    const float width = float(depths.width), height = float(depths.height);
    for (std::size_t i = 0; i < count; ++i) {
        const bool inside = x[i] >= 0 && y[i] >= 0 && x[i] < width && y[i] < height;
        depth[i] = inside ? depths(std::size_t(std::int32_t(x[i])), std::size_t(std::int32_t(y[i]))) : 1.0f;
    }
}

/// Depths of a block of texels in the row's range, each of one texel of the map.
template <rectified_depth measure>
rectify_lanes rectified_depths(map_view<const float> depths, const light_map& light, const rectified_frame& frame,
                               const rectified_row& row, std::size_t columns, std::size_t first, std::size_t count)
{
    const rectified_block block({light, frame, row, columns}, first);
    rectify_lanes depth{};
    fetch_depths(depths, block.x, block.y, count, depth);
    rectified_mapping(light, row).template apply<measure>(block.radius, depth);
    return depth;
}

/// Add the channels of depths, each times its weight, to sums for each channel.
template <storage_format Format>
void add_channels(const rectify_lanes& depth, const rectify_lanes& x_weight, const rectify_lanes& y_weight,
                  std::array<std::array<double, rectify_texels>, channel_count<Format>>& sums)
{
    for (std::size_t i = 0; i < rectify_texels; ++i) {
        const auto c = gnomon_bit_cast<channel_array<Format>>(Format::from_depth(depth[i]));
        const double weight = double(x_weight[i] * y_weight[i]);
        for (std::size_t k = 0; k < c.size(); ++k) sums[k][i] += weight * double(c[k]);
    }
}

/// Fill rows of a rectified map: block(row, first, count, numbers) gives the channels of texels as numbers.
template <texel_format Format>
void rectify_rows(map_view<format_texel<Format>> target, row_range band, const auto& block)
{
    std::array<float, rectify_texels * channel_count<Format>> numbers;
    for (std::size_t v = band.first; v < band.last; ++v)
        for (std::size_t u = 0; u < target.width; u += rectify_texels) {
            const std::size_t count = (std::min)(rectify_texels, target.width - u);
            block(v, u, count, numbers.data());
            store_row<Format>(numbers.data(), &target(u, v), count);
        }
}

template <class T, class U>
void expect_rectify(std::string_view pass, map_view<T> source, std::span<const rectified_row> rows, map_view<U> target,
                    row_range band)
{
    expect_map(pass, "source", source);
    expect_rectified(pass, "target", target, rows);
    expect_apart(pass, source, target);
    expect_rows(pass, target, band);
}

/// Calls pass.template operator()<measure>() for the measure of depth of a frame.
void with_measure(rectified_depth measure, const auto& pass)
{
    if (measure == rectified_depth::polar) pass.template operator()<rectified_depth::polar>();
    else pass.template operator()<rectified_depth::cosine>();
}

} // namespace detail

/// Fill the given rows of a rectified map with depths, each of the texel of the map that holds the light ray.
inline void rectify_depths(map_view<const float> depths, const light_map& light, const rectified_frame& frame,
                           std::span<const rectified_row> rows, map_view<float> target, row_range band)
{
    detail::expect_rectify("rectify_depths", depths, rows, target, band);
    detail::with_measure(frame.depth, [&]<rectified_depth measure>() {
        for (std::size_t v = band.first; v < band.last; ++v)
            for (std::size_t u = 0; u < target.width; u += detail::rectify_texels) {
                const std::size_t count = (std::min)(detail::rectify_texels, target.width - u);
                const auto z = detail::rectified_depths<measure>(depths, light, frame, rows[v], target.width, u, count);
                std::copy_n(z.begin(), count, &target(u, v));
            }
    });
}

/// Fill the given rows of a rectified map, each texel with the depth of the texel of the map that holds the light ray.
template <storage_format Format>
void rectify(map_view<const float> depths, const light_map& light, const rectified_frame& frame,
             std::span<const rectified_row> rows, map_view<format_texel<Format>> target, row_range band)
{
    detail::expect_rectify("rectify", depths, rows, target, band);
    detail::with_measure(frame.depth, [&]<rectified_depth measure>() {
        detail::rectify_rows<Format>(target, band, [&](std::size_t v, std::size_t u, std::size_t count, float* to) {
            const auto z = detail::rectified_depths<measure>(depths, light, frame, rows[v], target.width, u, count);
            for (std::size_t i = 0; i < count; ++i, to += channel_count<Format>) {
                const auto c = gnomon_bit_cast<channel_array<Format>>(Format::from_depth(z[i]));
                std::copy(c.begin(), c.end(), to);
            }
        });
    });
}

/// Fill the given rows of a rectified map, each texel with the mean over 4 x 4 texels of the map, which a cubic B-spline weights. The
/// spline is as wide as two footprints of the texel along each axis, and at least 4 texels of the map. One texel of the map
/// stands for each quarter of its width.
template <storage_format Format>
void rectify_filtered(map_view<const float> depths, const light_map& light, const rectified_frame& frame,
                      std::span<const rectified_row> rows, map_view<format_texel<Format>> target, row_range band)
{
    detail::expect_rectify("rectify_filtered", depths, rows, target, band);
    const float turn = frame.azimuth_length / float(rows.size());
    detail::with_measure(frame.depth, [&]<rectified_depth measure>() {
        detail::rectify_rows<Format>(target, band, [&](std::size_t v, std::size_t u, std::size_t count, float* to) {
            const detail::rectified_places at(light, frame, rows[v], target.width);
            const detail::rectified_mapping map(light, rows[v]);
            const detail::rectified_block block(at, u);
            const auto spacing = [&](float along, float side) {
                detail::rectify_lanes s;
                for (std::size_t i = 0; i < s.size(); ++i)
                    s[i] = gnomon_max(0.5f * ((std::abs)(along)*at.step + side * (block.radius[i] * turn)), 1.0f);
                return s;
            };
            const detail::spline_texels x(block.x, spacing(at.dx, at.side_x)), y(block.y, spacing(at.dy, at.side_y));
            std::array<std::array<double, detail::rectify_texels>, channel_count<Format>> sums{};
            detail::rectify_lanes z{};
            for (std::size_t k = 0; k < 16; ++k) {
                detail::fetch_depths(depths, x.at[k % 4], y.at[k / 4], count, z);
                map.template apply<measure>(block.radius, z);
                detail::add_channels<Format>(z, x.weight[k % 4], y.weight[k / 4], sums);
            }
            for (std::size_t i = 0; i < count; ++i)
                for (const auto& sum : sums) *to++ = float(sum[i]);
        });
    });
}

/// Errors by storage of the moments of a map, for two_point_distribution: the variance of a single depth, and the largest error
/// of a channel of theta4.
struct moments_noise {
    float least_variance, channel;
};
/// The errors of moments that are rounded to the format once.
template <class Source> inline constexpr moments_noise stored_noise{float(two_point_least_variance), 0x1p-25f};
template <>
inline constexpr moments_noise stored_noise<moments4_unorm16>{float(two_point_unorm16_least_variance), 0x1p-17f};
template <>
inline constexpr moments_noise stored_noise<moments4_half>{float(16 * two_point_unorm16_least_variance), 0x1p-13f};

/// Fill the given rows of a rectified map from a map of four moments and its mip chain: a trilinear sample as wide as the texel's
/// footprint becomes a distribution of two depths, each of which is mapped, and their mean (Peters et al. 2017, Alg. 2). Depths
/// that noise cannot tell from the far plane are no occluders.
template <storage_format Format, storage_format Source>
void rectify_moments(mip_view<const format_texel<Source>> moments, const light_map& light, const rectified_frame& frame,
                     std::span<const rectified_row> rows, map_view<format_texel<Format>> target, row_range band,
                     moments_noise noise = stored_noise<Source>)
{
    constexpr std::string_view pass = "rectify_moments";
    expect_mips(pass, moments);
    detail::expect_rectify(pass, map_view<const format_texel<Source>>(moments.texels, moments.width, moments.height),
                           rows, target, band);
    const float turn = frame.azimuth_length / float(rows.size());
    const float texels = (std::max)((std::abs)(light.texels_x), (std::abs)(light.texels_y));
    const float far_plane = 1 - gnomon_sqrt(noise.least_variance);
    detail::with_measure(frame.depth, [&]<rectified_depth measure>() {
        detail::rectify_rows<Format>(target, band, [&](std::size_t v, std::size_t u, std::size_t count, float* to) {
            const detail::rectified_places at(light, frame, rows[v], target.width);
            const detail::rectified_mapping map(light, rows[v], far_plane);
            const detail::rectified_block block(at, u);
            detail::rectify_lanes first{}, second{}, share{};
            for (std::size_t i = 0; i < count; ++i) {
                const float level = rectified_level(rectified_footprint(block.radius[i], at.step, turn, texels));
                const moments4<float> b =
                    Source::to_moments(trilinear<Source>(moments, block.x[i], block.y[i], level, border_mode::lit));
                const distribution2<float> d = two_point_distribution(
                    b.b1, b.b2, two_point_third_moment(b.b1, b.b2, b.b3, noise.channel), noise.least_variance);
                first[i] = d.depth1;
                second[i] = d.depth2;
                share[i] = d.weight2;
            }
            map.template apply<measure>(block.radius, first);
            map.template apply<measure>(block.radius, second);
            for (std::size_t i = 0; i < count; ++i) {
                const auto a = gnomon_bit_cast<channel_array<Format>>(Format::from_depth(first[i]));
                const auto b = gnomon_bit_cast<channel_array<Format>>(Format::from_depth(second[i]));
                for (std::size_t k = 0; k < a.size(); ++k)
                    *to++ = float(double(a[k]) + double(share[i]) * (double(b[k]) - double(a[k])));
            }
        });
    });
}

GNOMON_NAMESPACE_END
#endif
