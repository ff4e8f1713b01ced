// Moving triangles at a sample of the shadow map, three of four seen at some time:
//     covered times   from edges; the baseline is the usual route without its list of intervals, which sorts six roots
//                     and tests the middle between any two; prisms of Hong & Oh give about the same times
//     depth           at the ends of an interval, its line and a piece of it: from the vertices, and from a setup for
//                     many samples
//     translations    all results at a sample: by the kernels for any triangle, and by those for translations
//     a texel         of four ranges: shadow tests, and the search for a cover
#include "core/measure.hpp"
#include "support/moving_triangles.hpp"
#include "support/prisms.hpp"

#include <gnomon/comparators/prism.h>
#include <gnomon/motion/range/range_cover.h>
#include <gnomon/motion/triangle/moving_triangle.h>
#include <gnomon/motion/triangle/triangle_setup.h>
#include <gnomon/numerics/quadratic.h>

#include <algorithm>
#include <bit>

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
        return moving_depth_at(m, moving_triangle_edges(m, x[24], x[25]), real(0.5), real(1));
    }
};

struct prism_pairs : triangle_and_sample {
    static constexpr auto name = "covered time by a prism";
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, 26> x{operands...};
        const prism<real> p = prism_make(triangle(x), real(1));
        prism_pair<real> pair = prism_pair_begin(real(0));
        real k = real(0);
        for (int i = 0; i < 14; ++i, k = k + real(1))
            pair = prism_pair_add(pair, prism_fragment_at(prism_triangle_make(p, k), x[24], x[25], real(1)));
        const prism_ranges<real> ranges = prism_pair_end(pair);
        return range_duration(ranges.first) + range_duration(ranges.second);
    }
};

/// Edge functions and depths of a triangle around a sample, as in the setup of a rasterizer for a tile.
struct field_and_sample : compilation {
    static constexpr std::size_t inputs = 51;
    static std::vector<std::array<double, inputs>> samples(std::size_t count, std::uint64_t seed)
    {
        std::vector<std::array<double, inputs>> result(count);
        const auto triangles = triangle_and_sample::samples(count, seed);
        for (std::size_t i = 0; i < count; ++i) {
            const moving_triangle<double> m = triangle_and_sample::triangle(triangles[i]);
            const triangle_setup<double> field = triangle_setup_make(m, triangles[i][24], triangles[i][25]);
            const auto edges = std::bit_cast<std::array<double, 9>>(triangle_setup_edges(field, 0.0, 0.0));
            const auto depths = std::bit_cast<std::array<double, 16>>(depth_setup_make(field, m));
            auto at = std::copy(edges.begin(), edges.end(), result[i].begin());
            at = std::copy(depths.begin(), depths.end(), at);
            *at++ = 0;
            *at++ = 0;
            std::copy_n(triangles[i].begin(), 24, at);
        }
        return result;
    }

    template <class Real> static GNOMON_INLINE constexpr moving_edges<Real> edges(const std::array<Real, inputs>& x)
    {
        return {{x[0], x[1], x[2]}, {x[3], x[4], x[5]}, {x[6], x[7], x[8]}};
    }
    template <class Real> static GNOMON_INLINE constexpr depth_curve<Real> curve(const std::array<Real, inputs>& x)
    {
        const auto plane = [&](std::size_t k) GNOMON_BENCH_INLINE {
            return sample_plane<Real>{x[k], x[k + 1], x[k + 2]};
        };
        const depth_setup<Real> field{plane(9), plane(12), plane(15), plane(18), x[21], x[22], x[23], x[24]};
        return moving_depth_curve(field, edges(x), x[25], x[26]);
    }
    template <class Real>
    static GNOMON_INLINE constexpr moving_triangle<Real> corners(const std::array<Real, inputs>& x)
    {
        std::array<Real, 26> vertices;
        for (std::size_t i = 0; i < 24; ++i) vertices[i] = x[27 + i];
        return triangle_and_sample::triangle(vertices);
    }
};

struct vertex_depths : field_and_sample {
    static constexpr auto name = "two depths of the vertices";
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, inputs> x{operands...};
        const moving_triangle<real> m = corners(x);
        return moving_depth_at(m, edges(x), real(0.25), real(0)) + moving_depth_at(m, edges(x), real(0.75), real(0));
    }
};

struct field_depths : field_and_sample {
    static constexpr auto name = "two depths of a setup";
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const depth_curve<real> c = curve(std::array<real, inputs>{operands...});
        return depth_curve_at(c, real(0.25)) + depth_curve_at(c, real(0.75));
    }
};

/// The line between two depths with its deviation. The piece is the first within a tolerance that needs several.
struct vertex_line : field_and_sample {
    static constexpr auto name = "line of the vertices' depth";
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, inputs> x{operands...};
        return moving_depth_line(corners(x), edges(x), real(0.25), real(0.75), real(0)).deviation;
    }
};

struct field_line : field_and_sample {
    static constexpr auto name = "line of a setup's depth";
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, inputs> x{operands...};
        return depth_curve_line(curve(x), real(0.25), real(0.75)).deviation;
    }
};

struct vertex_piece : field_and_sample {
    static constexpr auto name = "piece of the vertices' depth";
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, inputs> x{operands...};
        return moving_depth_piece(corners(x), edges(x), real(0.25), real(0.75), real(0), real(0), real(0x1p-9)).z1;
    }
};

struct field_piece : field_and_sample {
    static constexpr auto name = "piece of a setup's depth";
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, inputs> x{operands...};
        return depth_curve_piece(curve(x), real(0.25), real(0.75), real(0), real(0x1p-9)).z1;
    }
};

/// A triangle whose vertices have the same motion, around a sample that its front covers in the middle of the shutter.
struct translated_field : compilation {
    static constexpr std::size_t inputs = 45;
    static std::vector<std::array<double, inputs>> samples(std::size_t count, std::uint64_t seed)
    {
        std::vector<std::array<double, inputs>> result(count);
        const auto triangles = triangle_and_sample::samples(count, seed);
        for (std::size_t i = 0; i < count; ++i) {
            moving_triangle<double> m = triangle_and_sample::triangle(triangles[i]);
            double x = 0, y = 0;
            for (moving_vertex<double>* v : {&m.a, &m.b, &m.c}) {
                v->x1 = v->x0 + (m.a.x1 - m.a.x0), v->y1 = v->y0 + (m.a.y1 - m.a.y0);
                v->z1 = v->z0 + (m.a.z1 - m.a.z0), v->w0 = m.a.w0, v->w1 = m.a.w1;
                x += (v->x0 + v->x1) / (m.a.w0 + m.a.w1) / 3, y += (v->y0 + v->y1) / (m.a.w0 + m.a.w1) / 3;
            }
            if (moving_edge_at(moving_triangle_edges(m, x, y).a, 0.5) < 0) std::swap(m.b, m.c);
            const triangle_setup<double> field = triangle_setup_make(m, x, y);
            const auto edges = std::bit_cast<std::array<double, 27>>(field);
            const auto depths = std::bit_cast<std::array<double, 16>>(depth_setup_make(field, m));
            std::copy(depths.begin(), depths.end(), std::copy(edges.begin(), edges.end(), result[i].begin()));
        }
        return result;
    }

    template <class Real> static GNOMON_INLINE constexpr triangle_setup<Real> edges(const std::array<Real, inputs>& x)
    {
        const auto edge = [&](std::size_t k) GNOMON_BENCH_INLINE {
            return edge_equation<Real>{
                {x[k], x[k + 1], x[k + 2]}, {x[k + 3], x[k + 4], x[k + 5]}, {x[k + 6], x[k + 7], x[k + 8]}};
        };
        return {edge(0), edge(9), edge(18)};
    }
    template <class Real> static GNOMON_INLINE constexpr depth_setup<Real> depths(const std::array<Real, inputs>& x)
    {
        const auto plane = [&](std::size_t k) GNOMON_BENCH_INLINE {
            return sample_plane<Real>{x[k], x[k + 1], x[k + 2]};
        };
        return {plane(27), plane(30), plane(33), plane(36), x[39], x[40], x[41], x[42]};
    }
};

struct any_sight : translated_field {
    static constexpr auto name = "translated, as any triangle";
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, inputs> x{operands...};
        const moving_edges<real> e = triangle_setup_edges(edges(x), x[43], x[44]);
        const depth_curve<real> depth = moving_depth_curve(depths(x), e, x[43], x[44]);
        const coverage_intervals<real> times = moving_coverage(e, real(1));
        return coverage_duration(times) + depth_curve_at(depth, times.begin0) + depth_curve_at(depth, times.end0);
    }
};

struct translated_sight : translated_field {
    static constexpr auto name = "translated, linear in time";
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, inputs> x{operands...};
        const moving_edges<real> e = triangle_setup_edges_linear(edges(x), x[43], x[44]);
        const depth_curve<real> depth = moving_depth_curve(depths(x), e, x[43], x[44]);
        const linear_interval<real> times = linear_coverage(e);
        return gnomon_max(times.end - times.begin, real(0)) + linear_depth_at(depth, times.begin) +
               linear_depth_at(depth, times.end);
    }
};

struct texel_of_ranges : compilation {
    static constexpr std::size_t inputs = 20;
    static std::vector<std::array<double, inputs>> samples(std::size_t count, std::uint64_t seed)
    {
        test::bit_source bits(seed);
        std::vector<std::array<double, inputs>> result(count);
        for (auto& sample : result)
            for (std::size_t k = 0; k < 4; ++k) {
                const depth_time_range<double> r = test::any_cover_range<double>(bits);
                std::copy_n(std::array{r.t0, r.t1, r.z0, r.z1, r.id}.begin(), 5, sample.begin() + 5 * k);
            }
        return result;
    }

    template <class Real>
    static GNOMON_INLINE constexpr depth_time_range<Real> range(const std::array<Real, inputs>& x, std::size_t k)
    {
        return {x[5 * k], x[5 * k + 1], x[5 * k + 2], x[5 * k + 3], x[5 * k + 4]};
    }
};

struct shadow_tests : texel_of_ranges {
    static constexpr auto name = "shadow tests of four ranges";
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, inputs> x{operands...};
        real intensity = real(0);
        for (std::size_t k = 0; k < 4; ++k)
            intensity = gnomon_max(intensity, range_intensity(range(x, k), real(0.5), real(0), real(9), real(0)));
        return intensity;
    }
};

struct cover_search : texel_of_ranges {
    static constexpr auto name = "cover of four ranges";
    template <class... Reals> static GNOMON_INLINE constexpr auto run(Reals... operands)
    {
        using real = std::common_type_t<Reals...>;
        const std::array<real, inputs> x{operands...};
        range_cover<real> state = range_cover_begin(real(1));
        for (std::size_t k = 0; k < 4; ++k) state = range_cover_add(state, range(x, k));
        return range_cover_end(state).id;
    }
};

[[maybe_unused]] const bool registered =
    add_kernels<sorted_roots, sorted_roots, coverage, depth, prism_pairs>("motion") &&
    add_kernels<vertex_depths, vertex_depths, field_depths>("motion") &&
    add_kernels<vertex_line, vertex_line, field_line>("motion") &&
    add_kernels<vertex_piece, vertex_piece, field_piece>("motion") &&
    add_kernels<any_sight, any_sight, translated_sight>("motion") &&
    add_kernels<shadow_tests, shadow_tests, cover_search>("motion");

} // namespace gnomon::bench::GNOMON_BENCH_ARITHMETIC
