// Separable blur of a shadow map in its storage format. Each pass decodes texels, sums over the taps in float and
// encodes the sum, so a blur of two passes rounds twice, as on a GPU. Beyond the map's edge the outermost texel
// repeats, or is lit (border_mode). No allocation; threads may blur different bands of rows. A NaN under a tap with a
// weight becomes the border.
//
//     const auto weights = gnomon::gaussian_weights();                                  // 9 taps
//     gnomon::blur<gnomon::moments4_unorm16>(map, scratch, map, weights);
#ifndef GNOMON_PASSES_BLUR_HPP
#define GNOMON_PASSES_BLUR_HPP

#include "map_view.hpp"

#include <algorithm>
#include <cmath>

GNOMON_NAMESPACE_BEGIN

/// Gaussian weights at whole distances from the middle tap, normalised to sum to 1 up to rounding. sigma is in texels, of
/// either sign: 0 is the middle tap alone, infinity gives all taps the same weight.
/// NaN: the middle tap alone.
template <std::size_t taps = 9> std::array<float, taps> gaussian_weights(double sigma = (taps - 1) / 4.0)
{
    static_assert(taps % 2 == 1, "gnomon: a blur has a middle tap");
    std::array<double, taps> weights{};
    const double spread = 2 * sigma * sigma;
    double sum = 0;
    for (std::size_t i = 0; i < taps; ++i) {
        const double distance = double(i) - double(taps / 2);
        const bool reached = spread > 0 && i != taps / 2;
        sum += weights[i] = reached ? std::exp(-distance * distance / spread) : i == taps / 2 ? 1 : 0;
    }
    std::array<float, taps> result{};
    for (std::size_t i = 0; i < taps; ++i) result[i] = float(weights[i] / sum);
    return result;
}

/// Largest number of taps that a blur accepts: its window of decoded texels lies on the stack.
inline constexpr std::size_t maximum_blur_taps = 63;

namespace detail {

template <class T> struct lines {
    T* data;
    std::size_t along, across; // steps between texels of a line, and between lines
};

/// Blur texels [first, last) of each of `count` lines of `length` texels, a few lines at a time, with the decoded
/// texels under the taps in a ring.
template <texel_format Format>
void blur_lines(lines<const format_texel<Format>> source, lines<format_texel<Format>> target, std::size_t length,
                std::size_t first, std::size_t last, std::size_t count, std::span<const float> weights,
                border_mode mode)
{
    constexpr std::size_t channels = channel_count<Format>;
    constexpr std::size_t batch = channels < 64 ? 64 / channels : 1;
    using decoded = std::array<float, batch * channels>;
    std::array<decoded, maximum_blur_taps> ring{};
    const std::size_t taps = weights.size();
    const std::size_t radius = taps / 2;
    const auto border = gnomon_bit_cast<channel_array<Format>>(stored_border<Format>());

    for (std::size_t begin = 0; begin < count; begin += batch) {
        const std::size_t lanes = (std::min)(batch, count - begin);
        // Position p of the line, which is padded by radius texels at both ends, has slot p % taps.
        const auto load = [&](std::size_t p) {
            const std::size_t i = (std::min)(p > radius ? p - radius : 0, length - 1);
            float* const slot = ring[p % taps].data();
            if (mode == border_mode::lit && i + radius != p) {
                for (std::size_t k = 0; k < lanes; ++k) std::copy(border.begin(), border.end(), slot + k * channels);
                return;
            }
            load_row<Format>(source.data + i * source.along + begin * source.across, slot, lanes, source.across);
        };
        for (std::size_t p = first; p < first + 2 * radius; ++p) load(p);
        for (std::size_t i = first; i < last; ++i) {
            load(i + 2 * radius);
            decoded sum{};
            for (std::size_t t = 0, slot = i % taps; t < taps; ++t, slot = slot + 1 == taps ? 0 : slot + 1) {
                const float weight = weights[t];
                if (!((std::abs)(weight) > 0)) continue; // 0 times NaN is NaN
                const decoded& tap = ring[slot];
                for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += weight * tap[k];
            }
            store_row<Format>(sum.data(), target.data + i * target.along + begin * target.across, lanes, target.across);
        }
    }
}

inline void expect_weights(std::string_view pass, std::span<const float> weights)
{
    GNOMON_EXPECTS(weights.size() % 2 == 1, mismatch(pass, "weights.size()", weights.size(), "its remainder by 2", 0));
    GNOMON_EXPECTS(weights.size() <= maximum_blur_taps,
                   mismatch(pass, "weights.size()", weights.size(), "maximum_blur_taps", maximum_blur_taps));
    double sum = 0;
    for (const float w : weights) sum += double(w);
    GNOMON_EXPECTS((std::abs)(sum - 1) <= 0.01, std::string("gnomon: ").append(pass) + ": the sum of weights is " +
                                                    std::to_string(sum) + ", but a filter needs 1");
}

template <texel_format Format>
void expect_blur(map_view<const format_texel<Format>> source, map_view<format_texel<Format>> target,
                 std::span<const float> weights, row_range rows)
{
    constexpr std::string_view pass = "blur";
    expect_map(pass, "source", source);
    expect_map(pass, "target", target);
    expect_same_extent(pass, source, target);
    expect_apart(pass, source, target);
    expect_rows(pass, target, rows);
    expect_weights(pass, weights);
}

} // namespace detail

/// Blur along x into the given rows of target. Target must not overlap source. Weights: an odd number of them, of any
/// sign, with a sum within 0.01 of 1.
template <texel_format Format>
void blur_along_x(map_view<const format_texel<Format>> source, map_view<format_texel<Format>> target,
                  std::span<const float> weights, row_range rows, border_mode mode = border_mode::clamp)
{
    detail::expect_blur<Format>(source, target, weights, rows);
    if (rows.first == rows.last) return;
    detail::blur_lines<Format>({&source(0, rows.first), 1, source.stride}, {&target(0, rows.first), 1, target.stride},
                               source.width, 0, source.width, rows.last - rows.first, weights, mode);
}

/// Blur along y into the given rows of target; reads source rows beyond these. Target must not overlap source.
template <texel_format Format>
void blur_along_y(map_view<const format_texel<Format>> source, map_view<format_texel<Format>> target,
                  std::span<const float> weights, row_range rows, border_mode mode = border_mode::clamp)
{
    detail::expect_blur<Format>(source, target, weights, rows);
    detail::blur_lines<Format>({source.texels.data(), source.stride, 1}, {target.texels.data(), target.stride, 1},
                               source.height, rows.first, rows.last, source.width, weights, mode);
}

/// Blur the whole map along both axes: source to scratch, scratch to target. Target may be source.
template <texel_format Format>
void blur(map_view<const format_texel<Format>> source, map_view<format_texel<Format>> scratch,
          map_view<format_texel<Format>> target, std::span<const float> weights, border_mode mode = border_mode::clamp)
{
    const row_range all{0, source.height};
    detail::expect_blur<Format>(source, scratch, weights, all);
    detail::expect_blur<Format>(scratch, target, weights, all);
    blur_along_x<Format>(source, scratch, weights, all, mode);
    blur_along_y<Format>(scratch, target, weights, all, mode);
}

GNOMON_NAMESPACE_END
#endif
