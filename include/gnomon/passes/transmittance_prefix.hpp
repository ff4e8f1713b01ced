// Transmittance-weighted prefix averages along the rows of a rectified map, in place, in its storage format (Peters et al. 2017,
// Sec. 5.1.1 and App. C): texel u becomes the average of texels 0 to u, weighted by the transmittance up to each
// (scattering/transmittance_weights.h), which is all that single scattering up to there depends on.
//
// Sums are in double, so an average is off by one rounding to the format and nothing else; sums in float would add several. With
// n texels, n <= 65536, of numbers of at most one in magnitude:
//     Error: 2^-25 + 2^-36 of formats of floats before encode rounds UNORM codes, absolute.
// The sums of weights are at least 1, the weight of the first texel, so that nothing cancels and no weight is too small to divide
// by: an extinction of 0 gives equal weights, an infinite one the first texel throughout.
//
// No allocation; threads may take different bands of rows. A texel with a channel that is NaN or infinite is the border, which
// shadows nothing.
#ifndef GNOMON_PASSES_TRANSMITTANCE_PREFIX_HPP
#define GNOMON_PASSES_TRANSMITTANCE_PREFIX_HPP

#include "rectified_map.hpp"

#include <algorithm>
#include <cmath>

GNOMON_NAMESPACE_BEGIN

namespace detail {

/// Texels of a row that are summed at once, and rows that share the weights of these if they have the same factor.
inline constexpr std::size_t prefix_texels = 64, prefix_rows = 8;

/// The weights of a block of texels, and the reciprocals of the sums of weights up to each.
struct prefix_weights {
    std::array<double, prefix_texels> weight, scale;

    /// Goes on in a row after the texels that it has the next weight and the sum of.
    void fill(auto& row, std::size_t count)
    {
        for (std::size_t i = 0; i < count; ++i) {
            weight[i] = row.next;
            scale[i] = row.sum += row.next;
            row.next *= row.factor;
        }
        for (std::size_t i = 0; i < count; ++i) scale[i] = 1 / scale[i];
    }
};

/// The weighted sum of a channel, and of a pair of channels.
struct prefix_sum {
    static constexpr std::size_t channels = 1;
    double sum = 0;

    GNOMON_INLINE void add(const float* texel, float* average, double weight, double scale)
    {
        sum += double(*texel) * weight;
        *average = float(sum * scale);
    }
};
#if defined(__GNUC__)
struct prefix_pair {
    static constexpr std::size_t channels = 2;
    typedef double vector __attribute__((vector_size(16)));
    vector sum{};

    GNOMON_INLINE void add(const float* texel, float* average, double weight, double scale)
    {
        sum += vector{double(texel[0]), double(texel[1])} * weight;
        const vector mean = sum * scale;
        average[0] = float(mean[0]);
        average[1] = float(mean[1]);
    }
};
#else
using prefix_pair = prefix_sum;
#endif

/// The weighted sums of the texels of a row so far. Pairs of many channels would not fit in registers.
template <std::size_t channels> struct prefix_sums {
    using part = std::conditional_t<channels % 2 == 0 && channels <= 8, prefix_pair, prefix_sum>;
    std::array<part, channels / part::channels> parts{};

    /// Replaces a block of texels by their averages with all texels before.
    void add(const prefix_weights& w, const float* texel, float* average, std::size_t count)
    {
        auto p = parts;
        for (std::size_t i = 0; i < count; ++i, texel += channels, average += channels)
            for (std::size_t k = 0; k < p.size(); ++k) {
                const std::size_t first = k * part::channels;
                p[k].add(texel + first, average + first, w.weight[i], w.scale[i]);
            }
        parts = p;
    }

    /// True if all texels so far had finite channels.
    [[nodiscard]] bool are_finite() const
    {
        const auto sums = gnomon_bit_cast<std::array<double, channels>>(parts);
        return std::all_of(sums.begin(), sums.end(), [](double s) { return (std::isfinite)(s); });
    }
};

/// A row of which some texels are averaged.
template <texel_format Format> struct prefix_row {
    static constexpr std::size_t channels = channel_count<Format>;

    double factor = 1, next = 1, sum = 0; // the weight of the next texel, and the sum of weights
    prefix_sums<channels> sums;

    /// Replaces the next texels by their averages.
    void add(const prefix_weights& weights, format_texel<Format>* texels, std::size_t count)
    {
        std::array<float, prefix_texels * channels> numbers;
        load_row<Format>(texels, numbers.data(), count);
        const auto before = sums;
        sums.add(weights, numbers.data(), numbers.data(), count);
        if (!sums.are_finite()) [[unlikely]] {
            sums = before;
            load_row<Format>(texels, numbers.data(), count);
            lighten_unknown(numbers, count);
            sums.add(weights, numbers.data(), numbers.data(), count);
        }
        store_row<Format>(numbers.data(), texels, count);
    }

  private:
    /// Replaces texels that have a channel without a finite number by the border.
    static void lighten_unknown(std::span<float> numbers, std::size_t count)
    {
        const auto border = gnomon_bit_cast<channel_array<Format>>(stored_border<Format>());
        for (std::size_t i = 0; i < count; ++i) {
            const auto texel = numbers.subspan(i * channels, channels);
            if (!std::all_of(texel.begin(), texel.end(), [](float x) { return (std::isfinite)(x); }))
                std::copy(border.begin(), border.end(), texel.begin());
        }
    }
};

} // namespace detail

/// Replace the texels in the given rows of a rectified map by prefix averages. rows has one entry for each row of the map; a
/// factor is clamped to [0, 1].
/// NaN: a factor of NaN is 1, an extinction of 0.
template <texel_format Format>
void transmittance_prefix(map_view<format_texel<Format>> map, std::span<const rectified_row> rows, row_range band)
{
    constexpr std::string_view pass = "transmittance_prefix";
    expect_rectified(pass, "map", map, rows);
    expect_rows(pass, map, band);
    for (std::size_t first = band.first; first < band.last; first += detail::prefix_rows) {
        std::array<detail::prefix_row<Format>, detail::prefix_rows> group{};
        const std::size_t count = (std::min)(group.size(), band.last - first);
        for (std::size_t k = 0; k < count; ++k)
            group[k].factor = clamp_or_high(double(rows[first + k].factor), 0.0, 1.0);
        detail::prefix_weights weights;
        for (std::size_t x = 0; x < map.width; x += detail::prefix_texels) {
            const std::size_t texels = (std::min)(detail::prefix_texels, map.width - x);
            for (std::size_t k = 0; k < count; ++k) {
                if (k == 0 || !(group[k].factor == group[k - 1].factor)) weights.fill(group[k], texels);
                group[k].add(weights, &map(x, first + k), texels);
            }
        }
    }
}

GNOMON_NAMESPACE_END
#endif
