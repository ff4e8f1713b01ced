// Transmittance-weighted prefix averages along the rows of a rectified map, in place, in its storage format (Peters et al. 2017,
// Sec. 5.1.1 and App. C): texel u becomes the average of texels 0 to u, weighted by the transmittance up to each
// (scattering/transmittance_weights.h). Single scattering up to there depends on nothing else.
//
// Sums are in double, so that an average has the error of one rounding to the format. For up to 65536 texels of numbers of at
// most one in magnitude:
//     Error: absolute, 2^-25 + 2^-36, before a UNORM format rounds to its codes.
// Sums of weights are at least 1, the weight of the first texel, so nothing cancels and no divisor is too small. An extinction
// of 0 gives equal weights, an infinite one the first texel throughout.
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

/// Texels of a row that are averaged at once.
inline constexpr std::size_t prefix_texels = 64;

/// The weights of a block of texels of a row, and the reciprocals of the sums of weights up to each.
class prefix_weights {
  public:
    std::array<double, prefix_texels> weight, scale;

    explicit prefix_weights(const rectified_row& row) : depth_(row.optical_depth), decay_(row.decay)
    {
        const double factor = clamp_or_high(double(row.factor), 0.0, 1.0);
        for (std::size_t k = 1; k <= step; ++k) {
            powers_[k] = powers_[k - 1] * factor;
            sums_[k] = sums_[k - 1] + powers_[k];
        }
        const float first = fog_weight(0);
        is_fog_ = !(decay_ == 0) && first > 0;
        if (is_fog_) next_ = 1 / double(first);
    }

    /// Fill in the weights of the texels from first on, those of the block after the last.
    void advance(std::size_t first)
    {
        if (is_fog_) advance_in_fog(first);
        else advance();
    }

  private:
    /// Fill in the weights of a row in a medium whose density changes, relative to the first.
    void advance_in_fog(std::size_t first)
    {
        for (std::size_t i = 0; i < prefix_texels; ++i) weight[i] = next_ * double(fog_weight(float(first + i)));
        for (std::size_t i = 0; i < prefix_texels; ++i) scale[i] = 1 / (sum_ += weight[i]);
    }
    [[nodiscard]] float fog_weight(float texel) const { return height_fog_weight(texel, texel + 1, decay_, depth_); }

    /// Fill in the next block.
    void advance()
    {
        const auto powers = powers_, sums = sums_;
        double next = next_, sum = sum_;
        for (std::size_t i = 0; i < prefix_texels; i += step) {
            for (std::size_t k = 0; k < step; ++k) weight[i + k] = next * powers[k];
            for (std::size_t k = 0; k < step; ++k) scale[i + k] = sum + next * sums[k];
            sum += next * sums[step - 1];
            next *= powers[step];
        }
        // The quotient in float, and a step of Newton's: 2^-47, in half the time of a quotient.
        for (double& s : scale) {
            const double rough = double(1 / float(s));
            s = rough * (2 - s * rough);
        }
        next_ = next;
        sum_ = sum;
    }

    static constexpr std::size_t step = 8;
    std::array<double, step + 1> powers_{1}, sums_{1}; // of the factor, and up to each
    double next_ = 1, sum_ = 0;                        // the weight of the next texel, and the sum of those before
    float depth_, decay_;
    bool is_fog_;
};

/// The weighted sum of a channel; and of two and four, as vectors of the compiler.
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
#if defined(__AVX__) && defined(__GNUC__)
struct prefix_quad {
    static constexpr std::size_t channels = 4;
    typedef float numbers __attribute__((vector_size(16)));
    typedef double vector __attribute__((vector_size(32)));
    vector sum{};

    GNOMON_INLINE void add(const float* texel, float* average, double weight, double scale)
    {
        numbers x;
        std::memcpy(&x, texel, sizeof x);
        sum += __builtin_convertvector(x, vector) * weight;
        x = __builtin_convertvector(sum * scale, numbers);
        std::memcpy(average, &x, sizeof x);
    }
};
#else
using prefix_quad = prefix_pair;
#endif

/// The weighted sums of the texels of a row so far. Vectors of many channels would not fit in registers.
template <std::size_t channels> class prefix_sums {
    static constexpr std::size_t in_vectors = channels <= 8 ? channels : 0;
    static constexpr std::size_t quads = in_vectors / prefix_quad::channels * prefix_quad::channels;
    static constexpr std::size_t pairs = (in_vectors - quads) / prefix_pair::channels * prefix_pair::channels;

  public:
    /// Write the averages of a block of texels with all texels before; average may be texel.
    void add(const prefix_weights& w, const float* texel, float* average, std::size_t count)
    {
        auto a = quads_;
        auto b = pairs_;
        auto c = rest_;
        for (std::size_t i = 0; i < count; ++i, texel += channels, average += channels) {
            const auto add_to = [&](auto& sums, std::size_t first) {
                for (auto& s : sums) {
                    s.add(texel + first, average + first, w.weight[i], w.scale[i]);
                    first += s.channels;
                }
            };
            add_to(a, 0);
            add_to(b, quads);
            add_to(c, quads + pairs);
        }
        quads_ = a;
        pairs_ = b;
        rest_ = c;
    }

    /// True if all texels so far had finite channels.
    [[nodiscard]] bool are_finite() const
    {
        const auto finite = [](const auto& sums) {
            return std::all_of(sums.begin(), sums.end(), [](const auto& sum) {
                std::array<double, std::remove_cvref_t<decltype(sum)>::channels> numbers;
                std::memcpy(numbers.data(), &sum, sizeof numbers);
                return std::all_of(numbers.begin(), numbers.end(), [](double s) { return (std::isfinite)(s); });
            });
        };
        return finite(quads_) && finite(pairs_) && finite(rest_);
    }

  private:
    std::array<prefix_quad, quads / prefix_quad::channels> quads_{};
    std::array<prefix_pair, pairs / prefix_pair::channels> pairs_{};
    std::array<prefix_sum, channels - quads - pairs> rest_{};
};

/// Replace texels that have a channel without a finite number by the border.
template <texel_format Format> void lighten_unknown(std::span<float> numbers)
{
    constexpr std::size_t channels = channel_count<Format>;
    const auto border = gnomon_bit_cast<channel_array<Format>>(stored_border<Format>());
    for (std::size_t i = 0; i < numbers.size(); i += channels) {
        const auto texel = numbers.subspan(i, channels);
        if (!std::all_of(texel.begin(), texel.end(), [](float x) { return (std::isfinite)(x); }))
            std::copy(border.begin(), border.end(), texel.begin());
    }
}

/// Replace the texels of a row by their averages.
template <texel_format Format> void average_row(std::span<format_texel<Format>> row, const rectified_row& medium)
{
    constexpr std::size_t channels = channel_count<Format>;
    prefix_weights weights(medium);
    prefix_sums<channels> sums;
    std::array<float, prefix_texels * channels> numbers;
    for (std::size_t first = 0; first < row.size(); first += prefix_texels) {
        const auto texels = row.subspan(first, (std::min)(prefix_texels, row.size() - first));
        weights.advance(first);
        const auto before = sums;
        if constexpr (holds_numbers<Format>) {
            sums.add(weights, texels.front().data(), numbers.data(), texels.size());
        } else {
            load_row<Format>(texels.data(), numbers.data(), texels.size());
            sums.add(weights, numbers.data(), numbers.data(), texels.size());
        }
        if (!sums.are_finite()) [[unlikely]] {
            sums = before;
            load_row<Format>(texels.data(), numbers.data(), texels.size());
            lighten_unknown<Format>(std::span(numbers).first(texels.size() * channels));
            sums.add(weights, numbers.data(), numbers.data(), texels.size());
        }
        store_row<Format>(numbers.data(), texels.data(), texels.size());
    }
}

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
    for (std::size_t v = band.first; v < band.last; ++v)
        detail::average_row<Format>(std::span(&map(0, v), map.width), rows[v]);
}

GNOMON_NAMESPACE_END
#endif
