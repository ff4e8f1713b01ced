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

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
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

    /// Whole numbers that are at least 0, as indices.
    std::array<std::int32_t, count> indices() const
    {
        std::array<std::int32_t, count> r;
        for (std::size_t i = 0; i < count; ++i) r[i] = static_cast<std::int32_t>(numbers[i]);
        return r;
    }
};

/// Neighbours of each lane, as numbers.
template <class Pack> struct neighbours_of_rays {
    Pack lower, upper, fraction;

    neighbours_of_rays(const Pack& coordinate, const Pack& extent)
    {
        const Pack one(1.0f), none(0.0f);
        const Pack x = gnomon_min(gnomon_max(coordinate, Pack(-0.0f)), extent - one), n = nearest_integer(x);
        lower = gnomon_select(x < n, n - one, n);
        fraction = x - lower;
        upper = lower + gnomon_select(none < fraction, one, none);
    }

    /// Those of rectified_rows_of.
    static neighbours_of_rays rows(const Pack& position, const Pack& rows, bool wraps)
    {
        const Pack half(0.5f), one(1.0f);
        if (!wraps) return {position - half, rows};
        neighbours_of_rays n(position + half, rows + Pack(2.0f));
        const auto wrapped = [&](Pack row) {
            row = row + (rows - one); // at most twice rows
            for (int k = 0; k < 2; ++k) row = gnomon_select(row < rows, row, row - rows);
            return row;
        };
        n.lower = wrapped(n.lower);
        n.upper = wrapped(n.upper);
        return n;
    }
};

/// The maps of rays in a mip chain, each of a level of its own, as far as they have different levels.
template <class Texel, class Pack> struct levels_of_rays {
    std::array<const Texel*, float_lanes<Pack>::count> texels;
    std::array<std::int32_t, float_lanes<Pack>::count> stride;
    float_lanes<Pack> width, height;

    levels_of_rays(mip_view<const Texel> mips, const std::array<std::int32_t, float_lanes<Pack>::count>& level)
    {
        map_view<const Texel> map = mips.level(std::size_t(level[0]));
        for (std::size_t i = 0; i < level.size(); ++i) {
            if (i > 0 && level[i] != level[i - 1]) map = mips.level(std::size_t(level[i]));
            texels[i] = map.texels.data();
            stride[i] = static_cast<std::int32_t>(map.width);
            width[i] = float(map.width);
            height[i] = float(map.height);
        }
    }
};

/// The look-up of rays at (x, y) of a map of width x height texels in levels of its mip chain: that of rectified_channels_of.
template <texel_format Format, class Pack> class channels_of_rays {
    static constexpr std::size_t lanes = float_lanes<Pack>::count;
    using texel = format_texel<Format>;

  public:
    channels_of_rays(mip_view<const texel> mips, const std::array<std::int32_t, lanes>& level, const Pack& x,
                     const Pack& y, std::span<const rectified_row> rows, bool wraps)
        : map_(mips, level)
    {
        const Pack width = map_.width.pack(), height = map_.height.pack(), half(0.5f);
        const Pack all_columns(float(mips.width)), all_rows(float(mips.height));
        const neighbours_of_rays<Pack> nx(x * (width / all_columns) - half, width);
        const auto ny = neighbours_of_rays<Pack>::rows(y * (height / all_rows), height, wraps);
        const Pack wide = all_columns / width, high = all_rows / height;
        const Pack before = (nx.lower + half) * wide + half;
        const auto medium = [&](const Pack& v) {
            const auto of_map = float_lanes<Pack>((v + half) * high).indices();
            float_lanes<Pack> depth, decay;
            for (std::size_t i = 0; i < lanes; ++i) {
                const rectified_row& row = rows[(std::min)(std::size_t(of_map[i]), rows.size() - 1)];
                depth[i] = row.optical_depth, decay[i] = row.decay;
            }
            return std::array{depth.pack(), decay.pack()};
        };
        const auto share_in = [&](const std::array<Pack, 2>& m) {
            return float_lanes<Pack>(rectified_share(before, wide, nx.fraction, m[0], m[1]));
        };
        const auto lower = medium(ny.lower), upper = medium(ny.upper);
        lower_share_ = share_in(lower);
        const bool are_alike = !gnomon_any(!(lower[0] == upper[0] && lower[1] == upper[1]));
        upper_share_ = are_alike ? lower_share_ : share_in(upper);
        row_share_ = float_lanes<Pack>(ny.fraction);
        left_ = float_lanes<Pack>(nx.lower).indices();
        right_ = float_lanes<Pack>(nx.upper).indices();
        lower_ = float_lanes<Pack>(ny.lower).indices();
        upper_ = float_lanes<Pack>(ny.upper).indices();
        for (std::size_t i = 0; i < lanes; ++i) lower_[i] *= map_.stride[i], upper_[i] *= map_.stride[i];
    }

    /// The channels of all rays, ray by ray.
    void mixed(std::array<channel_array<Format>, lanes>& result) const
    {
        std::array<texel, 4 * lanes> texels;
        for (std::size_t i = 0; i < lanes; ++i) {
            const texel* map = map_.texels[i];
            texels[4 * i] = map[lower_[i] + left_[i]];
            texels[4 * i + 1] = map[lower_[i] + right_[i]];
            texels[4 * i + 2] = map[upper_[i] + left_[i]];
            texels[4 * i + 3] = map[upper_[i] + right_[i]];
        }
        std::array<channel_array<Format>, 4 * lanes> c;
        load_row<Format>(texels.data(), c[0].data(), texels.size());
        for (std::size_t i = 0; i < lanes; ++i)
            result[i] = mix(mix(c[4 * i], c[4 * i + 1], lower_share_[i]),
                            mix(c[4 * i + 2], c[4 * i + 3], upper_share_[i]), row_share_[i]);
    }

  private:
    levels_of_rays<texel, Pack> map_;
    float_lanes<Pack> lower_share_, upper_share_, row_share_; // of the right texel in each row, and of the upper row
    std::array<std::int32_t, lanes> left_, right_, lower_, upper_;
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
    const Pack count(float(rows.size()));
    const auto n = detail::neighbours_of_rays<Pack>::rows(
        rectified_row_of(position.azimuth, Pack(frame.azimuth_start), Pack(frame.azimuth_length), count), count,
        frame.wraps());
    const bool is_polar = frame.depth == rectified_depth::polar;
    const Pack measure = is_polar ? position.polar : polynomial_cos(position.polar);
    const auto depth = [&](const Pack& row) {
        const auto of = lanes(row).indices();
        lanes middle, scale;
        for (std::size_t i = 0; i < lanes::count; ++i) {
            const rectified_range<float>& range = rows[std::size_t(of[i])].range;
            middle[i] = range.middle, scale[i] = range.scale;
        }
        const rectified_range<Pack> range{middle.pack(), scale.pack()};
        return is_polar ? rectified_polar_depth(measure, range) : rectified_cosine_depth(measure, range);
    };
    const Pack a = depth(n.lower), b = depth(n.upper);
    return a + n.fraction * (b - a);
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
    const auto border = gnomon_bit_cast<channel_array<Format>>(stored_border<Format>());
    if (rows.empty() || mips.width == 0 || mips.height == 0) {
        for (std::size_t i = 0; i < lanes::count; ++i) put(i, border);
        return gnomon_bit_cast<format_channels<Format, Pack>>(result);
    }
    const float step = rectified_radius_step(frame, mips.width);
    const Pack x = step > 0 ? rectified_column_of(position.radius, Pack(step)) : position.radius;
    const Pack y = rectified_row_of(position.azimuth, Pack(frame.azimuth_start), Pack(frame.azimuth_length),
                                    Pack(float(mips.height)));
    const detail::neighbours_of_rays<Pack> levels(level, Pack(float(mips.levels())));
    std::array<channel_array<Format>, lanes::count> low, high;
    const auto look_up = [&](const Pack& of, auto& to) {
        detail::channels_of_rays<Format, Pack>(mips, lanes(of).indices(), x, y, rows, frame.wraps()).mixed(to);
    };
    look_up(levels.lower, low);
    if (gnomon_any(Pack(0.0f) < levels.fraction)) {
        look_up(levels.upper, high);
        const lanes share(levels.fraction);
        for (std::size_t i = 0; i < lanes::count; ++i)
            if (share[i] > 0) low[i] = detail::mix(low[i], high[i], share[i]);
    }
    for (std::size_t i = 0; i < lanes::count; ++i) put(i, low[i]);
    const auto known = x == x && y == y && level == level;
    if (gnomon_any(!known)) {
        const lanes is_known(gnomon_select(known, Pack(1.0f), Pack(0.0f)));
        for (std::size_t i = 0; i < lanes::count; ++i)
            if (!(is_known[i] > 0)) put(i, border);
    }
    return gnomon_bit_cast<format_channels<Format, Pack>>(result);
}

} // namespace gnomon
#endif
