// Look-ups of view rays in rectified maps of prefix averages by packs of rays (passes/rectified_look_up.hpp, of which these have the
// bits). Places, depths and weights are computed for all rays at once. Only the texels are read ray by ray.
//
//     using real = gnomon::pack<xsimd::batch<float>>;
//     const rectified_position<real> position = rectified_from_position(x, y, z);
//     const auto c = rectified_channels<format>(mips, frame, rows, position, level);
//     const real z_f = rectified_depth_at(frame, rows, position);
#ifndef GNOMON_SIMD_RECTIFIED_LOOK_UP_HPP
#define GNOMON_SIMD_RECTIFIED_LOOK_UP_HPP

#include "../passes/rectified_look_up.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <type_traits>

namespace gnomon {

namespace detail {

/// One number of each lane of a pack of floats.
template <class Pack> struct float_lanes {
    static constexpr std::size_t count = sizeof(Pack) / sizeof(float);
    alignas(Pack) std::array<float, count> numbers;

    float_lanes() = default;
    explicit float_lanes(const Pack& x) { x.store_unaligned(numbers.data()); }

    float operator[](std::size_t i) const { return numbers[i]; }
    float& operator[](std::size_t i) { return numbers[i]; }
    Pack pack() const { return Pack::load_unaligned(numbers.data()); }
};

/// The places of rays in a map of prefix averages.
template <class Pack> struct rectified_places_of_rays {
    float_lanes<Pack> x, y;

    rectified_places_of_rays(const rectified_frame& frame, const rectified_position<Pack>& position, std::size_t width,
                             std::size_t height)
    {
        const float step = rectified_radius_step(frame, width);
        x = float_lanes<Pack>(step > 0 ? rectified_column_of(position.radius, Pack(step)) : position.radius);
        y = float_lanes<Pack>(rectified_row_of(position.azimuth, Pack(frame.azimuth_start), Pack(frame.azimuth_length),
                                               Pack(float(height))));
    }
};

/// The texels of a level that a ray's look-up mixes, and the shares of the upper ones.
template <class Pack> struct rectified_texels {
    std::array<neighbours, float_lanes<Pack>::count> nx, ny;
    float_lanes<Pack> lower_share, upper_share; // along the lower row and along the upper one

    /// level(i) is the map of lane i.
    rectified_texels(const rectified_places_of_rays<Pack>& at, std::size_t width, std::size_t height, const auto& level,
                     std::span<const rectified_row> rows, bool wraps)
    {
        float_lanes<Pack> before, wide, fraction, lower_depth, upper_depth;
        bool are_alike = true;
        for (std::size_t i = 0; i < nx.size(); ++i) {
            const auto map = level(i);
            const float w = float(width) / float(map.width), h = float(height) / float(map.height);
            nx[i] = neighbours_of<border_mode::clamp>(at.x[i] * (float(map.width) / float(width)) - 0.5f, map.width);
            ny[i] = rectified_rows_of(at.y[i] * (float(map.height) / float(height)), map.height, wraps);
            const auto optical_depth = [&](std::size_t v) {
                return rows[(std::min)(std::size_t((float(v) + 0.5f) * h), rows.size() - 1)].optical_depth;
            };
            before[i] = (float(nx[i].lower) + 0.5f) * w + 0.5f;
            wide[i] = w;
            fraction[i] = nx[i].fraction;
            lower_depth[i] = optical_depth(ny[i].lower);
            upper_depth[i] = optical_depth(ny[i].upper);
            are_alike &= lower_depth[i] == upper_depth[i];
        }
        const auto share = [&](const float_lanes<Pack>& depth) {
            return float_lanes<Pack>(
                transmittance_weight_between(before.pack(), wide.pack(), fraction.pack(), depth.pack()));
        };
        lower_share = share(lower_depth);
        upper_share = are_alike ? lower_share : share(upper_depth);
    }

    template <texel_format Format>
    channel_array<Format> mixed(std::size_t i, map_view<const format_texel<Format>> map) const
    {
        const auto row = [&](std::size_t v, float share) {
            return mix(load_channels<Format>(map(nx[i].lower, v)), load_channels<Format>(map(nx[i].upper, v)), share);
        };
        return mix(row(ny[i].lower, lower_share[i]), row(ny[i].upper, upper_share[i]), ny[i].fraction);
    }
};

} // namespace detail

/// The signed depths of view rays at positions.
/// NaN: NaN for a polar angle of NaN.
template <class Pack>
requires(!std::is_same_v<Pack, float>) Pack
    rectified_depth_at(const rectified_frame& frame, std::span<const rectified_row> rows,
                       const rectified_position<Pack>& position)
{
    using lanes = detail::float_lanes<Pack>;
    if (rows.empty()) return Pack(-1.0f);
    const lanes row(rectified_row_of(position.azimuth, Pack(frame.azimuth_start), Pack(frame.azimuth_length),
                                     Pack(float(rows.size()))));
    lanes fraction, lower_middle, lower_scale, upper_middle, upper_scale;
    for (std::size_t i = 0; i < lanes::count; ++i) {
        const detail::neighbours n = detail::rectified_rows_of(row[i], rows.size(), frame.wraps());
        fraction[i] = n.fraction;
        lower_middle[i] = rows[n.lower].range.middle, lower_scale[i] = rows[n.lower].range.scale;
        upper_middle[i] = rows[n.upper].range.middle, upper_scale[i] = rows[n.upper].range.scale;
    }
    const bool is_polar = frame.depth == rectified_depth::polar;
    const Pack measure = is_polar ? position.polar : polynomial_cos(position.polar);
    const auto depth = [&](const lanes& middle, const lanes& scale) {
        const rectified_range<Pack> range{middle.pack(), scale.pack()};
        return is_polar ? rectified_polar_depth(measure, range) : rectified_cosine_depth(measure, range);
    };
    const Pack a = depth(lower_middle, lower_scale), b = depth(upper_middle, upper_scale);
    return a + fraction.pack() * (b - a);
}

/// Channels for the ends of view rays at positions, in a mip chain of prefix averages.
/// Domain: any positions and levels. A map or rows without entries give the border, lit.
/// NaN: the border, for a radius, azimuth or level of NaN.
template <texel_format Format, class Pack>
requires(!std::is_same_v<Pack, float>) format_channels<Format, Pack> rectified_channels(
    mip_view<const format_texel<Format>> mips, const rectified_frame& frame, std::span<const rectified_row> rows,
    const rectified_position<Pack>& position, const Pack& level)
{
    using lanes = detail::float_lanes<Pack>;
    std::array<lanes, channel_count<Format>> result;
    const auto put = [&](std::size_t i, const channel_array<Format>& c) {
        for (std::size_t k = 0; k < c.size(); ++k) result[k][i] = c[k];
    };
    const bool is_empty = rows.empty() || mips.width == 0 || mips.height == 0;
    const detail::rectified_places_of_rays<Pack> at(frame, position, mips.width, mips.height);
    const lanes given(level);
    std::array<detail::neighbours, lanes::count> levels;
    bool is_between = false;
    for (std::size_t i = 0; i < lanes::count; ++i) {
        levels[i] = detail::neighbours_of<border_mode::clamp>(given[i], is_empty ? 1 : mips.levels());
        is_between |= levels[i].fraction > 0;
    }
    const auto lower = [&](std::size_t i) { return mips.level(levels[i].lower); };
    const auto upper = [&](std::size_t i) { return mips.level(levels[i].upper); };
    if (!is_empty) {
        const detail::rectified_texels<Pack> low(at, mips.width, mips.height, lower, rows, frame.wraps());
        for (std::size_t i = 0; i < lanes::count; ++i) put(i, low.template mixed<Format>(i, lower(i)));
        if (is_between) {
            const detail::rectified_texels<Pack> high(at, mips.width, mips.height, upper, rows, frame.wraps());
            for (std::size_t i = 0; i < lanes::count; ++i) {
                if (!(levels[i].fraction > 0)) continue;
                channel_array<Format> c;
                for (std::size_t k = 0; k < c.size(); ++k) c[k] = result[k][i];
                put(i, detail::mix(c, high.template mixed<Format>(i, upper(i)), levels[i].fraction));
            }
        }
    }
    const auto border = gnomon_bit_cast<channel_array<Format>>(stored_border<Format>());
    for (std::size_t i = 0; i < lanes::count; ++i)
        if (is_empty || (std::isunordered)(at.x[i], at.y[i]) || (std::isnan)(given[i])) put(i, border);
    return gnomon_bit_cast<format_channels<Format, Pack>>(result);
}

} // namespace gnomon
#endif
