// Receivers of shadows in motion: the cost of one range of a texel for static, moving and filtered receivers. The
// baseline is Palmer's five samples in time.
#include "core/measure.hpp"
#include "support/hostile.hpp"

#include <gnomon/motion/receiver/line_sample.h>
#include <gnomon/passes/range/shutters.hpp>

namespace gnomon::bench::GNOMON_BENCH_ARITHMETIC {

/// A path over up to four texels in either direction, in perspective half of the time, and a range.
struct path_and_range : compilation {
    static constexpr std::size_t inputs = 16;
    static std::vector<std::array<double, inputs>> samples(std::size_t count, std::uint64_t seed)
    {
        test::bit_source bits(seed);
        std::vector<std::array<double, inputs>> result(count);
        for (std::size_t i = 0; i < count; ++i) {
            const double w0 = i % 2 ? bits.uniform(0.5, 2) : 1, w1 = i % 2 ? bits.uniform(0.5, 2) : 1;
            const auto at = [&](double w) { return bits.uniform(1, 5) * w; };
            const double a = bits.uniform(0, 1), b = bits.uniform(0, 1);
            const double z0 = bits.uniform(-1, 1), z1 = bits.uniform(-1, 1);
            const double early = std::min(a, b), late = std::max(a, b);
            result[i] = {0,
                         1,
                         z0,
                         z1,
                         1,
                         at(w0),
                         at(w0),
                         w0,
                         at(w1),
                         at(w1),
                         w1,
                         early,
                         late,
                         bits.uniform(-1, 1),
                         bits.uniform(-1, 1),
                         2};
        }
        return result;
    }
    template <class Real> static GNOMON_INLINE constexpr depth_time_range<Real> range(const Real* x)
    {
        return {x[0], x[1], x[2], x[3], x[4]};
    }
    template <class Real> static GNOMON_INLINE constexpr receiver_path<Real> path(const std::array<Real, 16>& x)
    {
        return {range(x.data()), x[5], x[6], x[7], x[8], x[9], x[10]};
    }
};

struct five_samples : path_and_range {
    static constexpr auto name = "receiver, five samples";
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, 16> x{operands...};
        const receiver_path<real> p = path(x);
        sampled_receiver<real> state = sampled_receiver_begin(real(5));
        real texels = real(0); // finding the texels is part of the work
        for (int k = 0; k < 5; ++k) {
            const real t = receiver_sample_time(p, real(static_cast<lane_t<real>>(k)), real(5), real(0.5));
            const texel_position<real> at = receiver_path_at(p, t);
            texels = gnomon_max(texels, texel_below(at.x) + texel_below(at.y));
            const real z = range_depth(p.depth, t);
            state = sampled_receiver_add(state, range_intensity(range(&x[11]), t, z, p.depth.id, real(0)));
        }
        return gnomon_min(sampled_receiver_end(state), texels + real(2));
    }
};

struct receiver_static : path_and_range {
    static constexpr auto name = "static receiver, one range";
    static constexpr bool has_error = true;
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, 16> x{operands...};
        const auto state = static_receiver_begin(x[2], x[4], x[0], x[1]);
        return static_receiver_end(add_range(state, range(&x[11]), box_shutter{}));
    }
};

struct receiver_behind : path_and_range {
    static constexpr auto name = "static receiver behind a summary";
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, 16> x{operands...};
        const range_summary<real> total{x[13], x[13], x[12], real(3)};
        const auto state = static_receiver_begin(x[2], x[4], real(0), real(1));
        const real behind = static_receiver_is_behind(state, total);
        return behind * static_receiver_end(static_receiver_add(state, total.shadowed));
    }
};

struct receiver_moving : path_and_range {
    static constexpr auto name = "moving receiver, one range";
    static constexpr bool has_error = true;
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, 16> x{operands...};
        const auto state = moving_receiver_begin(path(x), x[0], x[1]);
        return moving_receiver_end(add_range(state, range(&x[11]), box_shutter{}));
    }
};

struct receiver_filtered : path_and_range {
    static constexpr auto name = "moving receiver, one range of a bilinear tap";
    static constexpr bool has_error = true;
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, 16> x{operands...};
        auto state = moving_receiver_begin(path(x), x[0], x[1]);
        state.u0 = x[11], state.v0 = x[12], state.u1 = x[12], state.v1 = x[11];
        return moving_receiver_end(add_filtered_range(state, range(&x[11]), box_shutter{}));
    }
};

struct receiver_sweep : path_and_range {
    static constexpr auto name = "moving receiver, first two texels";
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, 16> x{operands...};
        return texel_sweep_next(texel_sweep_begin(path(x))).t_end;
    }
};

struct receiver_crossed : path_and_range {
    static constexpr auto name = "receiver on crossed lines, one range each";
    static constexpr bool has_error = true;
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, 16> x{operands...};
        const auto at_x = line_sample_place_of(x[5]), at_y = line_sample_place_of(x[6]);
        const auto hidden = [&](real place, real z) { return range_intensity(range(&x[11]), place, z, x[4], real(0)); };
        return line_sample_intensity(hidden(at_x.place, x[2]), hidden(at_x.place, x[3]), hidden(at_y.place, x[2]),
                                     hidden(at_y.place, x[3]), at_x.place, at_y.place);
    }
};

[[maybe_unused]] const bool registered =
    add_kernels<five_samples, five_samples, receiver_static, receiver_behind, receiver_moving, receiver_filtered,
                receiver_sweep, receiver_crossed>("receivers");

} // namespace gnomon::bench::GNOMON_BENCH_ARITHMETIC
