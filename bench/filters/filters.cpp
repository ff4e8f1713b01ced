// The filters other than moment shadow maps, one look-up of a filtered map each; percentage-closer filtering over 9
// texels. The baseline is Algorithm 1 for four moments, as for the moment kernels.
#include "core/measure.hpp"
#include "moments/moments.hpp"

#include <gnomon/comparators/hamburger_cholesky.h>
#include <gnomon/filters/convolution.h>
#include <gnomon/filters/depth_bias.h>
#include <gnomon/filters/exponential.h>
#include <gnomon/filters/exponential_variance.h>
#include <gnomon/filters/layered_variance.h>
#include <gnomon/filters/percentage_closer.h>
#include <gnomon/filters/variance.h>
#include <gnomon/storage/moments4.h>

namespace gnomon::bench::GNOMON_BENCH_ARITHMETIC {

/// Operands f_1(z) to f_n(z), averaged over a distribution, and z_f.
template <std::size_t n, class Encode>
std::vector<std::array<double, n + 1>> averages(std::size_t count, std::uint64_t seed, Encode encode)
{
    test::distribution_source source(seed);
    std::vector<std::array<double, n + 1>> result(count);
    for (std::size_t i = 0; i < count; ++i) {
        const test::distribution d = source.draw(static_cast<test::family>(i % test::family_count));
        for (std::size_t k = 0; k < d.depths.size(); ++k) {
            const std::array<double, n> values = encode(d.depths[k]);
            for (std::size_t j = 0; j < n; ++j) result[i][j] += d.weights[k] * values[j];
        }
        result[i][n] = source.receiver(d);
    }
    return result;
}

struct algorithm1 : moments_and_receiver<4>, compilation {
    template <class Real> static GNOMON_INLINE constexpr Real run(Real b1, Real b2, Real b3, Real b4, Real z_f)
    {
        const moments4<Real> b = moments4_add_bias(moments4<Real>{b1, b2, b3, b4}, literal<Real>(bias4_raw_b2),
                                                   literal<Real>(bias4_raw_b4), literal<Real>(stored4_float_weight));
        return hamburger4_cholesky_intensity(b, z_f);
    }
};

struct closer9 : compilation {
    static constexpr auto name = "percentage closer, 9 texels";
    static constexpr std::size_t inputs = 10;
    static std::vector<std::array<double, inputs>> samples(std::size_t count, std::uint64_t seed)
    {
        std::mt19937_64 random(seed);
        std::uniform_real_distribution<double> depth(-1, 1);
        std::vector<std::array<double, inputs>> result(count);
        for (auto& operands : result)
            for (double& z : operands) z = depth(random);
        return result;
    }
    template <class... Depths> static GNOMON_INLINE constexpr auto run(Depths... operands)
    {
        using real = std::common_type_t<Depths...>;
        const std::array<real, inputs> z{operands...};
        percentage_closer<real> state = percentage_closer_begin(z[9]);
        for (std::size_t k = 0; k < 9; ++k) state = percentage_closer_add(state, z[k], literal<real>(1.0 / 9.0));
        return percentage_closer_end(state);
    }
};

struct variance : compilation {
    static constexpr auto name = "variance";
    static constexpr std::size_t inputs = 3;
    static constexpr bool has_error = true;
    static auto samples(std::size_t count, std::uint64_t seed)
    {
        return averages<2>(count, seed, [](double z) { return std::array{z, z * z}; });
    }
    template <class Real> static GNOMON_INLINE constexpr Real run(Real mean, Real square, Real z_f)
    {
        return variance_intensity(variance_moments<Real>{mean, square}, z_f, {literal<Real>(2e-7)});
    }
};

struct layered : compilation {
    static constexpr auto name = "layered variance, 4 layers";
    static constexpr std::size_t inputs = 9;
    static constexpr bool has_error = true;
    template <class Real> static constexpr layered_variance_settings<Real> settings(std::size_t layer)
    {
        return {literal<Real>(0.5 * static_cast<double>(layer) - 0.75), literal<Real>(4), literal<Real>(2e-7)};
    }
    static auto samples(std::size_t count, std::uint64_t seed)
    {
        return averages<8>(count, seed, [](double z) {
            std::array<double, 8> values{};
            for (std::size_t k = 0; k < 4; ++k) {
                const auto b = layered_variance_encode(z, settings<double>(k));
                values[2 * k] = b.mean;
                values[2 * k + 1] = b.square;
            }
            return values;
        });
    }
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, inputs> f{operands...};
        layered_variance<real> state = layered_variance_begin(f[8]);
        for (std::size_t k = 0; k < 4; ++k)
            state = layered_variance_add(state, {f[2 * k], f[2 * k + 1]}, settings<real>(k));
        return layered_variance_end(state);
    }
};

struct exponential : compilation {
    static constexpr auto name = "exponential";
    static constexpr std::size_t inputs = 2;
    static constexpr bool has_error = true;
    static auto samples(std::size_t count, std::uint64_t seed)
    {
        return averages<1>(count, seed, [](double z) { return std::array{std::exp(40 * z)}; });
    }
    template <class Real> static GNOMON_INLINE constexpr Real run(Real warped, Real z_f)
    {
        return exponential_intensity(exponential_moment<Real>{warped}, z_f, {literal<Real>(40)});
    }
};

struct exponential_variance : compilation {
    static constexpr auto name = "exponential variance";
    static constexpr std::size_t inputs = 5;
    static constexpr bool has_error = true;
    static auto samples(std::size_t count, std::uint64_t seed)
    {
        return averages<4>(count, seed, [](double z) {
            const auto b = exponential_variance_encode(z, {40.0, 5.54, 0.0});
            return std::array{b.positive, b.positive_square, b.negative, b.negative_square};
        });
    }
    template <class Real> static GNOMON_INLINE constexpr Real run(Real p, Real p2, Real n, Real n2, Real z_f)
    {
        return exponential_variance_intensity(exponential_variance_moments<Real>{p, p2, n, n2}, z_f,
                                              {literal<Real>(40), literal<Real>(5.54), literal<Real>(4e-12)});
    }
};

inline constexpr convolution_settings<double> series{16, 0, 0.04, 0.9375};
inline constexpr std::array<double, 16> series_weights = [] {
    std::array<double, 16> weights{};
    for (std::size_t k = 0; k < 16; ++k) weights[k] = convolution_weight(static_cast<double>(k + 1), series);
    return weights;
}();

struct convolution : compilation {
    static constexpr auto name = "convolution, 16 terms";
    static constexpr std::size_t inputs = 33;
    static constexpr bool has_error = true;
    static auto samples(std::size_t count, std::uint64_t seed)
    {
        return averages<32>(count, seed, [](double z) {
            std::array<double, 32> values{};
            auto phase = convolution_encode(z, series);
            for (std::size_t k = 0; k < 16; ++k, phase = convolution_next(phase)) {
                values[2 * k] = phase.cosine;
                values[2 * k + 1] = phase.sine;
            }
            return values;
        });
    }
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, inputs> f{operands...};
        const convolution_settings<real> settings{literal<real>(series.terms), literal<real>(series.damping),
                                                  literal<real>(series.offset), literal<real>(series.span)};
        convolution_sum<real> state = convolution_begin(f[32], settings);
        for (std::size_t k = 0; k < 16; ++k)
            state = convolution_add(state, f[2 * k], f[2 * k + 1], literal<real>(series_weights[k]));
        return convolution_end(state);
    }
};

/// Operands, each drawn evenly from [least, greatest].
template <std::size_t n>
std::vector<std::array<double, n>> even(std::size_t count, std::uint64_t seed, double least, double greatest)
{
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> number(least, greatest);
    std::vector<std::array<double, n>> result(count);
    for (auto& operands : result)
        for (double& x : operands) x = number(random);
    return result;
}

struct bias_of_slope : compilation {
    static constexpr auto name = "depth bias, slope-scaled";
    static constexpr std::size_t inputs = 3;
    static constexpr bool has_error = true;
    static auto samples(std::size_t count, std::uint64_t seed) { return even<inputs>(count, seed, 0.001, 1); }
    template <class Real> static GNOMON_INLINE constexpr Real run(Real across, Real along, Real rise)
    {
        return depth_bias_slope_scaled(across, along, rise, literal<Real>(5.67));
    }
};

struct bias_of_plane : compilation {
    static constexpr auto name = "depth bias, receiver plane from derivatives";
    static constexpr std::size_t inputs = 6;
    static constexpr bool has_error = true;
    static auto samples(std::size_t count, std::uint64_t seed) { return even<inputs>(count, seed, -1, 1); }
    template <class Real>
    static GNOMON_INLINE constexpr Real run(Real x1, Real y1, Real depth1, Real x2, Real y2, Real depth2)
    {
        return depth_bias_receiver_plane(depth_gradient_from_derivatives(x1, y1, depth1, x2, y2, depth2),
                                         literal<Real>(5.5), literal<Real>(5.5), literal<Real>(0.25));
    }
};

struct perspective : compilation {
    static constexpr auto name = "depth from a perspective buffer";
    static constexpr std::size_t inputs = 1;
    static constexpr bool has_error = true;
    static auto samples(std::size_t count, std::uint64_t seed) { return even<inputs>(count, seed, 0, 1); }
    template <class Real> static GNOMON_INLINE constexpr Real run(Real z)
    {
        return depth_from_perspective(z, literal<Real>(0.5), literal<Real>(40));
    }
};

[[maybe_unused]] const bool registered =
    add_kernels<algorithm1, closer9, variance, layered, exponential, exponential_variance, convolution, bias_of_slope,
                bias_of_plane, perspective>("filters");

} // namespace gnomon::bench::GNOMON_BENCH_ARITHMETIC
