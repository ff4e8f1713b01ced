// Covers of texels, from fragments and from ranges, against the surface in front at many times.
#include "cover_cases.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

TEST_CASE_TEMPLATE("a cover lasts and is in front at all times; ranges find one wherever fragments do, in any order", T,
                   float, double)
{
    bit_source bits(1);
    std::int64_t by_fragments = 0, by_ranges = 0, missed = 0;
    for (std::int64_t i = 0; i < effort(60'000); ++i) {
        const list<T> ranges = any_list<T>(bits);
        const fragments<T> all = ends_of(ranges);
        const auto from_ranges = cover_of(ranges), from_fragments = cover_of(all);
        REQUIRE(equal(from_ranges, cover_of(shuffled(ranges, bits))));
        REQUIRE(equal(from_fragments, cover_of(shuffled(all, bits))));
        for (const auto& cover : {from_ranges, from_fragments}) {
            if (cover.id < 0) {
                REQUIRE(cover.id == -1);
                REQUIRE(cover.t0 > cover.t1);
                continue;
            }
            REQUIRE((cover.t0 == 0 && cover.t1 == 1));
            REQUIRE(front_most(ranges, cover.id));
        }
        REQUIRE((rules_on(ranges) >= 0) == (from_ranges.id >= 0));
        if (from_fragments.id >= 0) {
            REQUIRE(from_ranges.id >= 0);
            const T farthest = std::max(from_fragments.z0, from_fragments.z1);
            REQUIRE(std::max(from_ranges.z0, from_ranges.z1) <= farthest);
        }
        by_fragments += from_fragments.id >= 0;
        by_ranges += from_ranges.id >= 0;
        for (T id = 0; id < 5 && from_ranges.id < 0; ++id)
            if (front_most(ranges, id)) {
                ++missed;
                break;
            }
    }
    CHECK(5 * by_ranges > effort(60'000));
    CHECK(by_fragments <= by_ranges);
    CHECK(by_fragments > 0);
    MESSAGE("covered by ranges " << by_ranges << ", by fragments " << by_fragments
                                 << "; in front at all times, but for a moment not of the cover's farther end "
                                 << missed);
}

// Triangles translated past a sample, by prisms and by exact times, against the triangle that is in front as a static
// triangle at each time.
TEST_CASE("covers of translated triangles, from prisms and from covered times")
{
    bit_source bits(2);
    std::int64_t from_prisms = 0, from_times = 0;
    for (std::int64_t i = 0; i < effort(20'000); ++i) {
        std::array<moving_triangle<double>, 4> m;
        fragments<double> all;
        list<double> ranges;
        for (std::size_t k = 0; k < 4; ++k) {
            std::array<moving_vertex<double>, 3> v;
            const double size = bits.chance(0.5) ? 4 : 1, x = bits.uniform(-1, 1), y = bits.uniform(-1, 1);
            const double centre = bits.uniform(-0.8, 0.8), z = bits.uniform(-0.1, 0.1);
            for (auto& p : v) {
                p = {size * bits.uniform(-1, 1),
                     size * bits.uniform(-1, 1),
                     centre + bits.uniform(-0.1, 0.1),
                     1,
                     0,
                     0,
                     0,
                     1};
                p.x1 = p.x0 + x, p.y1 = p.y0 + y, p.z1 = p.z0 + z;
            }
            m[k] = {v[0], v[1], v[2]};
            const prism<double> p = prism_make(m[k], 1.0);
            for (int j = 0; j < 14; ++j) {
                const auto f = prism_fragment_at(prism_triangle_make(p, double(j)), 0.0, 0.0, 1.0);
                if (f.covered > 0) all.push_back({f.time, f.depth, double(k)});
            }
            const moving_edges<double> e = moving_triangle_edges(m[k], 0.0, 0.0);
            for (const double facing : {1.0, -1.0}) {
                const auto c = moving_coverage(e, facing);
                for (std::size_t j = 0; j < std::size_t(c.count); ++j) {
                    const interval t = intervals_of(c)[j];
                    ranges.push_back(range_between(t.begin, moving_depth_at(m[k], e, t.begin, 1), t.end,
                                                   moving_depth_at(m[k], e, t.end, 1), double(k)));
                }
            }
        }
        const auto by_prisms = cover_of(all), by_times = cover_of(ranges);
        from_prisms += by_prisms.id >= 0;
        from_times += by_times.id >= 0;
        for (const auto& cover : {by_prisms, by_times})
            for (int j = 0; j <= 64 && cover.id >= 0; ++j) {
                const double t = j / 64.0;
                double own = 2, others = 2;
                for (std::size_t k = 0; k < 4; ++k) {
                    const moving_edges<double> e = moving_triangle_edges(m[k], 0.0, 0.0);
                    const double a = moving_edge_at(e.a, t), b = moving_edge_at(e.b, t), c = moving_edge_at(e.c, t);
                    const bool there = (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
                    double& z = double(k) == cover.id ? own : others;
                    if (there) z = std::min(z, moving_depth_at(m[k], e, t, 1));
                }
                REQUIRE(own <= others + 1e-9);
                REQUIRE(own <= 1);
            }
    }
    CHECK(from_prisms > 0);
    CHECK(from_times >= from_prisms);
}

TEST_CASE("the three passes of the paper, case by case")
{
    const auto cover = [](const fragments<double>& all) { return cover_of(all); };
    const timed_fragment<double> open{0, -0.5, 3}, close{1, -0.25, 3};
    CHECK(equal(cover({open, close}), {0, 1, -0.5, -0.25, 3}));
    CHECK(equal(cover({close, open}), {0, 1, -0.5, -0.25, 3}));
    CHECK(cover({}).id == -1);
    CHECK(cover({open}).id == -1);
    CHECK(cover({open, {0.75, -0.25, 3}}).id == -1);                        // leaves early
    CHECK(cover({open, close, {0.5, 0, 4}}).id == 3);                       // something behind
    CHECK(cover({open, close, {0.5, -0.25, 4}}).id == 3);                   // LESS
    CHECK(cover({open, close, {0.5, -0.3, 4}}).id == -1);                   // nearer than the farther end
    CHECK(cover({open, close, {0.5, -0.75, 4}}).id == -1);                  // the nearest at a moment
    CHECK(cover({open, close, {0.25, -0.5, 3}, {0.75, -0.5, 3}}).id == -1); // left and returned: the paper covers it
    CHECK(cover({open, close, {0.5, 0, -1}}).id == 3);                      // no triangle

    const depth_time_range<double> c{0, 1, -0.5, -0.25, 3};
    CHECK(range_cover_answer(c, 0.5, 0.0, 4.0, 0.0).intensity == 1);
    CHECK(range_cover_answer(c, 0.5, 0.0, 3.0, 0.0).intensity == 0);
    CHECK(range_cover_answer(c, 0.5, 0.0, 3.0, 0.0).decided == 0); // where its surface is not
    CHECK(range_cover_answer(c, 0.5, -0.3, 3.0, 0.0).decided == 1);
    CHECK(range_cover_answer(c, 0.5, -0.45, 4.0, 0.0).intensity == 0); // in front of it
    CHECK(range_cover_answer(range_empty(-1.0), 0.5, 0.0, 4.0, 0.0).decided == 0);
    CHECK(range_cover_occludes(c, {0.5, 0.75, -0.25, 0, 4}) == 0);
    CHECK(range_cover_occludes(c, {0.5, 0.75, -0.24, 0, 4}) == 1);
    CHECK(range_cover_occludes(c, {0.75, 0.5, -1, -1, 4}) == 1); // empty
    CHECK(range_cover_occludes(range_empty(-1.0), {0.5, 0.75, 1, 1, 4}) == 0);
}

TEST_CASE_TEMPLATE("any input gives a cover within the limits or none, and a NaN occludes nothing", T, float, double)
{
    hostile_source<T> hostile(4);
    bit_source bits(5);
    const T nan = std::numeric_limits<T>::quiet_NaN();
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        list<T> ranges = any_list<T>(bits);
        const auto clean = cover_of(ranges);
        list<T> dirty = ranges;
        depth_time_range<T> bad = ranges[0];
        (bits.chance(0.5) ? bad.z0 : bits.chance(0.5) ? bad.z1 : bits.chance(0.5) ? bad.t0 : bad.t1) = nan;
        dirty.insert(dirty.begin() + std::ptrdiff_t(bits.below(dirty.size() + 1)), bad);
        REQUIRE(equal(cover_of(dirty), clean));
        REQUIRE(range_cover_occludes(clean, bad) == 1);
        fragments<T> all = ends_of(ranges);
        const auto clean_fragments = cover_of(all);
        timed_fragment<T> worse = all[0];
        (bits.chance(0.3) ? worse.z : bits.chance(0.5) ? worse.t : worse.id) = nan;
        all.insert(all.begin() + std::ptrdiff_t(bits.below(all.size() + 1)), worse);
        REQUIRE(equal(cover_of(all), clean_fragments));

        const bool patterns = bits.chance(0.5);
        const auto any = [&] { return patterns ? hostile.pattern() : hostile.special(); };
        for (auto& r : dirty)
            if (bits.chance(0.7)) r = {any(), any(), any(), any(), any()};
        for (auto& f : all)
            if (bits.chance(0.7)) f = {any(), any(), any()};
        const auto cover = cover_of(dirty), cover_fragments = cover_of(all);
        REQUIRE(equal(cover, cover_of(shuffled(dirty, bits))));
        REQUIRE(equal(cover_fragments, cover_of(shuffled(all, bits))));
        for (const auto& c : {cover, cover_fragments}) {
            REQUIRE((c.id >= 0 || c.id == -1));
            REQUIRE((std::abs(c.z0) <= 1 && std::abs(c.z1) <= 1));
            const auto answer = range_cover_answer(c, any(), any(), any(), any());
            REQUIRE((answer.intensity == 0 || answer.intensity == 1));
            REQUIRE((answer.decided == 0 || answer.decided == 1));
        }
    }
}
