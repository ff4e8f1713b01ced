// Ranges of prisms against exact coverage: equal for translations; for other motions a table of their errors.
#include "motion/triangle/coverage_check.hpp"
#include "support/effort.hpp"
#include "support/moving_triangles.hpp"
#include "support/prisms.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

/// The time during which the triangle is present by exactly one of exact coverage and ranges.
double disagreement(const coverage_intervals<double>& front, const coverage_intervals<double>& back,
                    const prism_ranges<double>& ranges)
{
    std::vector<double> times{0, 1};
    std::vector<interval> truth, found;
    for (const auto& x : {front, back})
        for (std::size_t k = 0; k < std::size_t(x.count); ++k) truth.push_back(intervals_of(x)[k]);
    for (const auto& r : {ranges.first, ranges.second})
        if (r.t0 < r.t1) found.emplace_back(r.t0, r.t1);
    for (const auto* list : {&truth, &found})
        for (const interval& i : *list) times.push_back(i.begin), times.push_back(i.end);
    std::sort(times.begin(), times.end());
    double sum = 0;
    for (std::size_t k = 1; k < times.size(); ++k) {
        const double middle = (times[k - 1] + times[k]) / 2;
        const auto there = [&](const std::vector<interval>& list) {
            return std::any_of(list.begin(), list.end(),
                               [&](interval i) { return i.begin <= middle && middle <= i.end; });
        };
        if (there(truth) != there(found)) sum += times[k] - times[k - 1];
    }
    return sum;
}

enum class motion { translation, scaling, turned30, turned90, free, along_z, shifted };

/// A random motion, with a sample anywhere within its bounds.
moving_scene draw_motion(motion how, bit_source& bits)
{
    std::array<detail::point, 3> q, r;
    const detail::point shift = detail::any_point(bits), raw = detail::any_point(bits), about = detail::any_point(bits);
    const double norm = std::hypot(raw[0], raw[1], raw[2]);
    const detail::point axis{raw[0] / norm, raw[1] / norm, raw[2] / norm};
    const double angle = std::acos(-1.0) / (how == motion::turned30 ? 6 : 2);
    const bool perspective = how == motion::along_z || how == motion::shifted;
    std::array<moving_vertex<double>, 3> v;
    std::array<double, 4> box{9, -9, 9, -9};
    for (std::size_t k = 0; k < 3; ++k) {
        q[k] = detail::any_point(bits);
        switch (how) {
            case motion::translation:
            case motion::shifted:
                r[k] = {q[k][0] + shift[0], q[k][1] + shift[1], q[k][2] + shift[2]};
                break;
            case motion::scaling:
                r[k] = {2 * q[k][0] + shift[0], 2 * q[k][1] + shift[1], 2 * q[k][2] + shift[2]};
                break;
            case motion::free:
                r[k] = detail::any_point(bits);
                break;
            case motion::along_z:
                r[k] = q[k];
                break;
            default:
                r[k] = detail::turned(q[k], about, axis, angle);
        }
        const auto seen = [&](const detail::point& p, double z) -> std::array<double, 4> {
            const double w = perspective ? 2.5 + z : 1;
            return {p[0], p[1], z, w};
        };
        const double push = how == motion::along_z ? shift[2] / 2 : 0;
        v[k] = detail::vertex_between(seen(q[k], q[k][2] / (perspective ? 2 : 1)),
                                      seen(r[k], r[k][2] / (perspective ? 2 : 1) + push));
        for (const auto& [x, y] :
             {std::pair{v[k].x0 / v[k].w0, v[k].y0 / v[k].w0}, std::pair{v[k].x1 / v[k].w1, v[k].y1 / v[k].w1}}) {
            box[0] = std::min(box[0], x), box[1] = std::max(box[1], x);
            box[2] = std::min(box[2], y), box[3] = std::max(box[3], y);
        }
    }
    return {{v[0], v[1], v[2]}, bits.uniform(box[0], box[1]), bits.uniform(box[2], box[3])};
}

struct shares {
    std::int64_t wrong = 0, odd = 0, fragments = 0, unpaired = 0, two = 0;
    double worst = 0;
};

shares measure(motion how, std::int64_t count)
{
    bit_source bits(20 + std::uint64_t(how));
    shares s;
    for (std::int64_t i = 0; i < count; ++i) {
        const moving_scene scene = draw_motion(how, bits);
        const moving_edges<double> e = moving_triangle_edges(scene.triangle, scene.s_x, scene.s_y);
        const auto front = moving_coverage(e, 1.0), back = moving_coverage(e, -1.0);
        const prism_pair<double> pair = pair_at(prism_make(scene.triangle, 1.0), scene.s_x, scene.s_y);
        s.fragments += std::int64_t(pair.count);
        if (pair.count != 2 && pair.count != 4) s.unpaired += std::int64_t(pair.count);
        s.odd += std::fmod(pair.count, 2) != 0;
        s.two += pair.count == 4;
        const double time = disagreement(front, back, prism_pair_end(pair));
        s.wrong += time > 0.05;
        s.worst = std::max(s.worst, time);
    }
    return s;
}

} // namespace

// The sides are planes and time is affine on them, so the ranges differ only by the rounding of slivers. Depth at a
// sample is linear in time if it is linear in view distance; z / w is right at the ends.
TEST_CASE("for translations, also in perspective, prisms give the exact ranges and depths")
{
    for (const motion how : {motion::translation, motion::shifted}) {
        bit_source bits(6);
        std::int64_t seen = 0;
        for (std::int64_t i = 0; i < effort(100'000); ++i) {
            const moving_scene scene = draw_motion(how, bits);
            const moving_triangle<double>& m = scene.triangle;
            const moving_edges<double> e = moving_triangle_edges(m, scene.s_x, scene.s_y);
            const double area = std::abs(e.a.e0 + e.b.e0 + e.c.e0);
            const auto front = moving_coverage(e, 1.0), back = moving_coverage(e, -1.0);
            REQUIRE((front.count == 0 || back.count == 0));
            const auto& x = front.count > 0 ? front : back;
            if (x.count == 0 || x.end0 - x.begin0 < 1e-6 || area < 1e-3) continue;
            ++seen;
            for (const double divided : {0.0, 1.0}) {
                const auto r = prism_pair_end(pair_at(prism_make(m, divided), scene.s_x, scene.s_y, divided));
                REQUIRE(r.count == 1);
                REQUIRE(std::abs(r.first.t0 - x.begin0) <= 1e-9);
                REQUIRE(std::abs(r.first.t1 - x.end0) <= 1e-9);
                REQUIRE(std::abs(r.first.z0 - moving_depth_at(m, e, x.begin0, divided)) <= 1e-9);
                REQUIRE(std::abs(r.first.z1 - moving_depth_at(m, e, x.end0, divided)) <= 1e-9);
                REQUIRE(r.first.id == 7);
                if (how == motion::translation || divided == 1) continue; // depths beyond the limits, or no line
                const double t = bits.uniform(x.begin0, x.end0);
                REQUIRE(std::abs(range_depth(r.first, t) - moving_depth_at(m, e, t, 0)) <= 1e-9);
            }
        }
        CHECK(4 * seen > effort(100'000));
    }
}

// Shares of all triangles, less than half of which cover the sample at any time.
TEST_CASE("prisms are exact for motions with plane sides, and wrong for over 5% of rotations and deformations")
{
    const std::array<std::string, 7> names{
        "translation",           "scaling by 2",           "rotation by 30 degrees",    "rotation by 90 degrees",
        "vertices on their own", "along z in perspective", "translation in perspective"};
    const std::int64_t count = effort(40'000);
    std::array<shares, 7> table;
    for (std::size_t k = 0; k < 7; ++k) {
        table[k] = measure(motion(k), count);
        const shares& s = table[k];
        const auto percent = [](std::int64_t part, std::int64_t whole) {
            return std::to_string(100 * double(part) / double(whole)) + "%";
        };
        MESSAGE(names[k] << ": wrong for more than 5% of the shutter: " << percent(s.wrong, count) << ", at most by "
                         << s.worst << "; two ranges " << percent(s.two, count)
                         << "; fragments of which there are not two or four " << percent(s.unpaired, s.fragments));
        CHECK(10'000 * s.odd <= count); // the surface is closed
    }
    for (const std::size_t k : {0u, 1u, 5u, 6u}) CHECK(table[k].worst < 1e-6);
    for (const std::size_t k : {2u, 3u, 4u}) CHECK(20 * table[k].wrong > count);
}
