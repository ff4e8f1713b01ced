// Moving triangles, a sample of the shadow map each, seen at some time three times in four: covered times from edges
// on. The baseline is the usual way, without its list of intervals: six roots sorted, the middle of every two tried.
// Then receivers: what one range of a texel costs at rest, moving, filtered, and by Palmer's five samples, the
// baseline.
#include "measure.hpp"

#include "../tests/support/moving_triangles.hpp"

#include <gnomon/motion/moving_receiver.h>
#include <gnomon/motion/moving_triangle.h>
#include <gnomon/numerics/quadratic.h>

namespace gnomon::bench::GNOMON_BENCH_ARITHMETIC {

struct triangle_and_sample : compilation {
    static constexpr std::size_t inputs = 26;
    static std::vector<std::array<double, inputs>> samples(std::size_t count, std::uint64_t seed)
    {
        test::bit_source bits(seed);
        std::vector<std::array<double, inputs>> result(count);
        for (std::size_t i = 0; i < count; ++i) {
            const test::moving_scene scene = test::draw_moving_scene(test::movement(i % 5), bits);
            const moving_vertex<double>* vertices[] = {&scene.triangle.a, &scene.triangle.b, &scene.triangle.c};
            auto at = result[i].begin();
            for (const auto* v : vertices)
                for (const double x : {v->x0, v->y0, v->z0, v->w0, v->x1, v->y1, v->z1, v->w1}) *at++ = x;
            *at++ = scene.s_x;
            *at++ = scene.s_y;
        }
        return result;
    }

    template <class Real> static GNOMON_INLINE constexpr moving_triangle<Real> triangle(const std::array<Real, 26>& x)
    {
        const auto vertex = [&](std::size_t k) GNOMON_BENCH_INLINE {
            return moving_vertex<Real>{x[k], x[k + 1], x[k + 2], x[k + 3], x[k + 4], x[k + 5], x[k + 6], x[k + 7]};
        };
        return {vertex(0), vertex(8), vertex(16)};
    }
};

struct sorted_roots : triangle_and_sample {
    static constexpr auto name = "covered time by sorted roots";
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, 26> x{operands...};
        const moving_edges<real> e = moving_triangle_edges(triangle(x), x[24], x[25]);
        const std::array edges{e.a, e.b, e.c};
        std::array<real, 8> times;
        times[6] = real(0);
        times[7] = real(1);
        for (std::size_t k = 0; k < 3; ++k) {
            const real b = edges[k].e1 - edges[k].e0;
            const quadratic_result<real> roots = quadratic_roots(edges[k].e2 - edges[k].e1 - b, b, edges[k].e0);
            times[2 * k] = saturate_or_zero(roots.first);
            times[2 * k + 1] = saturate_or_zero(roots.second);
        }
        for (std::size_t end = 7; end > 0; --end)
            for (std::size_t k = 0; k < end; ++k) {
                const real earlier = gnomon_min(times[k], times[k + 1]);
                times[k + 1] = gnomon_max(times[k], times[k + 1]);
                times[k] = earlier;
            }
        real covered = real(0);
        for (std::size_t k = 0; k < 7; ++k) {
            const real middle = (times[k] + times[k + 1]) * real(0.5);
            const real least = gnomon_min(gnomon_min(moving_edge_at(e.a, middle), moving_edge_at(e.b, middle)),
                                          moving_edge_at(e.c, middle));
            covered = covered + gnomon_select(real(0) <= least, times[k + 1] - times[k], real(0));
        }
        return covered;
    }
};

struct coverage : triangle_and_sample {
    static constexpr auto name = "covered times";
    static constexpr bool has_error = true;
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, 26> x{operands...};
        return coverage_duration(moving_coverage(moving_triangle_edges(triangle(x), x[24], x[25]), real(1)));
    }
};

struct depth : triangle_and_sample {
    static constexpr auto name = "depth";
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, 26> x{operands...};
        const moving_triangle<real> m = triangle(x);
        return moving_triangle_depth(m, moving_triangle_edges(m, x[24], x[25]), real(0.5));
    }
};

/// A path over up to four texels either way, in perspective half of the time, and a range on it.
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
        real texels = real(0); // where each is looked up is part of the work
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

struct receiver_at_rest : path_and_range {
    static constexpr auto name = "receiver at rest, one range";
    static constexpr bool has_error = true;
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, 16> x{operands...};
        const auto state = static_receiver_begin(x[2], x[4], x[0], x[1]);
        return static_receiver_end(static_receiver_add_box(state, range(&x[11])));
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
        return moving_receiver_end(moving_receiver_add_box(state, range(&x[11])));
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
        return moving_receiver_end(moving_receiver_filter_box(state, range(&x[11])));
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

[[maybe_unused]] const bool of_receivers =
    add_kernels<five_samples, five_samples, receiver_at_rest, receiver_moving, receiver_filtered, receiver_sweep>(
        "motion");
[[maybe_unused]] const bool registered = add_kernels<sorted_roots, sorted_roots, coverage, depth>("motion");

} // namespace gnomon::bench::GNOMON_BENCH_ARITHMETIC
