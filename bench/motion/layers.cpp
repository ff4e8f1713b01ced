// Layers of stochastic shadow maps: a sample on its way into a layer, a footprint, and visibility through a layer. The baseline
// is the shadow of a plain variance map.
#include "core/measure.hpp"
#include "support/hostile.hpp"

#include <gnomon/motion/layers/layer_look_up.h>
#include <gnomon/motion/layers/layer_sums.h>

namespace gnomon::bench::GNOMON_BENCH_ARITHMETIC {

/// A moving sample, the moments of a texel, its opacity and weight, and a receiver.
struct sample_and_texel : compilation {
    static constexpr std::size_t inputs = 14;
    static std::vector<std::array<double, inputs>> samples(std::size_t count, std::uint64_t seed)
    {
        test::bit_source bits(seed);
        std::vector<std::array<double, inputs>> result(count);
        for (auto& sample : result) {
            const auto unit = [&] { return bits.uniform(-1, 1); };
            const double a = unit(), b = unit(), weight = double(1 + bits.below(16)),
                         opacity = weight * bits.uniform(0.1, 1);
            const auto sum = [&](double near_power, double far_power) {
                return opacity * (near_power + far_power) / 2;
            };
            sample = {6 * unit(),
                      6 * unit(),
                      bits.uniform(0, 1),
                      unit(),
                      20 * unit(),
                      20 * unit(),
                      0.1 * unit(),
                      sum(a, b),
                      sum(a * a, b * b),
                      sum(a * a * a, b * b * b),
                      sum(a * a * a * a, b * b * b * b),
                      opacity,
                      weight,
                      unit()};
        }
        return result;
    }
    template <class Real> static GNOMON_INLINE constexpr stochastic_sample<Real> sample(const std::array<Real, 14>& x)
    {
        return {x[0], x[1], x[2], x[3], x[4], x[5], x[6], Real(1)};
    }
    /// A grid of a layer, made already.
    template <class Real> static GNOMON_INLINE constexpr layer_grid<Real> grid(const std::array<Real, 14>& x)
    {
        return {Real(0.75), Real(0.625), x[11],   x[12],     gnomon_abs(x[4]), x[6],
                Real(4),    x[13],       Real(2), Real(0.5), Real(0.0625)};
    }
};

struct plain_variance : sample_and_texel {
    static constexpr auto name = "shadow of a plain variance map";
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, inputs> x{operands...};
        return variance_intensity(variance_moments<real>{x[7], x[8]}, x[13], {real(0x1p-20)});
    }
};

struct layer_bin : sample_and_texel {
    static constexpr auto name = "middle depth, bin, and four steps of the cuts";
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, inputs> x{operands...};
        const layer_window<real> window = layer_window_add(layer_window_begin(x[13]), layer_middle_depth(sample(x)));
        layer_runs<real> runs = layer_cuts_begin(window);
        for (const std::size_t k : {0, 1, 4, 5}) runs = layer_cuts_add(runs, x[k]); // occupied if above 0
        const layer_cuts<real> cuts = layer_cuts_end(runs, real(4));
        return layer_of(x[3], cuts) + layer_bin_of(x[3], window);
    }
};

struct layer_mean_motion : sample_and_texel {
    static constexpr auto name = "motion of a layer, one sample";
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, inputs> x{operands...};
        const stochastic_sample<real> s = sample(x);
        const layer_motion<real> m = layer_motion_end(layer_motion_add(layer_motion_begin(s), s, x[3]));
        return (m.d_x + m.d_y) + (m.spread + m.greatest);
    }
};

struct layer_sample : sample_and_texel {
    static constexpr auto name = "sample into the sums of a layer";
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, inputs> x{operands...};
        const layer_grid<real> g = grid(x);
        const layer_place<real> place = layer_grid_place(g, x[0], x[1], x[2]);
        const layer_share<real> share =
            layer_share_of(layer_of(x[3], layer_cuts<real>{x[8], real(3), real(3)}), real(0));
        const layer_sums<real> sums =
            layer_sums_add(layer_sums<real>{x[7], x[8], x[11], x[12]}, layer_grid_own_depth(g, x[3], x[2]), share);
        return layer_place_is_inside(g, place) + ((sums.z + sums.zz) + (sums.opacity + sums.weight));
    }
};

struct layer_probes : sample_and_texel {
    static constexpr auto name = "footprint and bias";
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, inputs> x{operands...};
        const layer_grid<real> g = grid(x);
        const real t1 = x[2] + real(0.25), widening = layer_widening(g, x[2]);
        const layer_footprint<real> f =
            layer_footprint_make(g, x[0], x[1], x[2], x[1], x[0], t1, x[3], x[13], widening);
        const layer_place<real> first = layer_probe(f, real(0));
        return (first.u + first.v) + (f.level + layer_bias(g, x[3], x[3], x[2], real(1.5), real(0.25)));
    }
};

struct layer_by_variance : sample_and_texel {
    static constexpr auto name = "visibility through a layer, variance";
    static constexpr bool has_error = true;
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, inputs> x{operands...};
        return layer_visibility(layer_sums<real>{x[7], x[8], x[11], x[12]}, x[13], real(0x1p-20));
    }
};

struct layer_by_moments : sample_and_texel {
    static constexpr auto name = "visibility through a layer, four moments";
    static constexpr bool has_error = true;
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, inputs> x{operands...};
        return layer_moments4_visibility(layer_moments4_sums<real>{x[7], x[8], x[9], x[10], x[11], x[12]}, x[13],
                                         real(64));
    }
};

struct layer_by_exponential : sample_and_texel {
    static constexpr auto name = "visibility through a layer, exponential";
    static constexpr bool has_error = true;
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, inputs> x{operands...};
        return layer_exponential_visibility(layer_exponential_sums<real>{gnomon_abs(x[7]), x[11], x[12]}, x[13],
                                            {real(40)});
    }
};

[[maybe_unused]] const bool registered =
    add_kernels<plain_variance, plain_variance, layer_bin, layer_mean_motion, layer_sample, layer_probes,
                layer_by_variance, layer_by_moments, layer_by_exponential>("layer_kernels");

} // namespace gnomon::bench::GNOMON_BENCH_ARITHMETIC
