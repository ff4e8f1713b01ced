// Moving triangles, a sample of the shadow map each, seen at some time three times in four: covered times from edges
// on. The baseline is the usual way, without its list of intervals: six roots sorted, the middle of every two tried.
// Lists of ranges after it: one more range, and the resolve.
#include "measure.hpp"

#include "../tests/support/moving_triangles.hpp"

#include <gnomon/motion/moving_triangle.h>
#include <gnomon/motion/range_list.h>
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

/// Eight ranges of a texel and a ninth. The baseline is the way without lists: the front of all nine at 16 times, as 16
/// shadow maps would have it.
struct nine_ranges : compilation {
    static constexpr std::size_t inputs = 45;
    static std::vector<std::array<double, inputs>> samples(std::size_t count, std::uint64_t seed)
    {
        test::bit_source bits(seed);
        std::vector<std::array<double, inputs>> result(count);
        for (auto& sample : result)
            for (std::size_t k = 0; k < inputs; k += 5) {
                const double t = bits.uniform(0, 1), z = bits.uniform(-1, 1);
                const double numbers[] = {t, std::min(t + bits.uniform(0, 0.5), 1.0), z,
                                          std::clamp(z + bits.uniform(-0.3, 0.3), -1.0, 1.0), double(bits.below(8))};
                std::copy(std::begin(numbers), std::end(numbers), sample.begin() + std::ptrdiff_t(k));
            }
        return result;
    }

    template <class Real>
    static GNOMON_INLINE constexpr depth_time_range<Real> range(const std::array<Real, inputs>& x, std::size_t k)
    {
        return {x[5 * k], x[5 * k + 1], x[5 * k + 2], x[5 * k + 3], x[5 * k + 4]};
    }

    /// The first eight as they come, what insertion would leave of them aside.
    template <class Real> static GNOMON_INLINE constexpr range_list<Real> list(const std::array<Real, inputs>& x)
    {
        range_list<Real> all;
        for (std::size_t k = 0; k < 8; ++k) all.ranges[k] = range(x, k);
        all.time_added = all.depth_added = Real(0);
        return all;
    }
};

struct sixteen_times : nine_ranges {
    static constexpr auto name = "front at 16 times";
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, inputs> x{operands...};
        real sum = real(0);
        for (int i = 0; i < 16; ++i) {
            const real t = real(static_cast<lane_t<real>>((i + 0.5) / 16));
            real front = real(1);
            for (std::size_t k = 0; k < 9; ++k) {
                const depth_time_range<real> r = range(x, k);
                front = gnomon_select(r.t0 <= t && t < r.t1, gnomon_min(front, range_depth(r, t)), front);
            }
            sum = sum + front;
        }
        return sum;
    }
};

/// Where the eight do not hide one another, there is no room for the ninth.
struct list_insert : nine_ranges {
    static constexpr auto name = "insert into a list of 8";
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, inputs> x{operands...};
        const range_list<real> all = range_list_insert(list(x), range(x, 8));
        return all.ranges[0].z0 + all.ranges[7].z0 + all.depth_added;
    }
};

struct list_front : nine_ranges {
    static constexpr auto name = "front of a list of 8";
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, inputs> x{operands...};
        const depth_time_range<real> span = range_list_front(list(x), real(0.5));
        return span.t1 + span.z0 + span.z1;
    }
};

struct list_resolve : nine_ranges {
    static constexpr auto name = "resolve of a list of 8";
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, inputs> x{operands...};
        const range_list<real> all = range_list_resolve(list(x));
        return all.ranges[0].z0 + all.ranges[7].z0 + all.depth_added;
    }
};

[[maybe_unused]] const bool registered = add_kernels<sorted_roots, sorted_roots, coverage, depth>("motion");
[[maybe_unused]] const bool lists_registered =
    add_kernels<sixteen_times, sixteen_times, list_insert, list_front, list_resolve>("motion");

} // namespace gnomon::bench::GNOMON_BENCH_ARITHMETIC
