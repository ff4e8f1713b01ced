// Begins and ends of surfaces, in place and time, for the rasterizer of motion: fans of triangles around a vertex that
// sits on a texel's centre, or beside it by a few ulps, leave no crack, and what passes a plane of the view is there
// for a part of the time.
#include "motion/range/moving_worlds.hpp"
#include "renderer/raster/moving_samples.hpp"
#include "support/effort.hpp"
#include "support/hostile.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

using namespace gnomon;
using namespace gnomon::test;
using namespace gnomon::renderer;

namespace {

enum class fan_motion { at_rest, carried, deforming };

struct fan {
    moving_part part;
    int x, y;         // the texel
    float begin, end; // when the fan is sure to cover the texel's centre
};

/// Triangles around a vertex that is on a texel's centre, or near it, at a time: for all of the shutter at rest.
fan any_fan(bit_source& bits, fan_motion how)
{
    const auto real = [&](double low, double high) { return bits.uniform(low, high); };
    const auto beside = [&] { return bits.chance(0.5) ? 0 : (bits.chance(0.5) ? 1 : -1) * std::exp2(real(-24, -12)); };
    fan f{{}, int(8 + bits.below(48)), int(8 + bits.below(48)), 0, 1};
    const glm::dvec3 centre(f.x + 0.5 + beside(), 0, f.y + 0.5 + beside());
    const double radius = std::exp2(real(-2, 2.5)), t = real(0, 1);
    const glm::dvec3 velocity = how == fan_motion::at_rest
                                    ? glm::dvec3(0)
                                    : std::exp2(real(-6, 2)) * glm::dvec3(real(-1, 1), real(-0.1, 0.1), real(-1, 1));
    const auto add = [&](const glm::dvec3& at, const glm::dvec3& extra) {
        f.part.add(glm::vec3(at - t * (velocity + extra)), glm::vec3(at + (1 - t) * (velocity + extra)));
    };
    add(centre, {});
    const auto corners = std::uint32_t(5 + bits.below(8));
    for (std::uint32_t k = 0; k < corners; ++k) {
        const double angle = 2 * std::numbers::pi * (k + real(0, 0.9)) / corners;
        const glm::dvec3 out = radius * glm::dvec3(std::cos(angle), real(-0.2, 0.2), std::sin(angle));
        const glm::dvec3 extra = how == fan_motion::deforming
                                     ? 0.1 * radius * glm::dvec3(real(-1, 1), real(-1, 1), real(-1, 1))
                                     : glm::dvec3(0);
        add(centre + out, extra);
        f.part.open.triangles.push_back({0, k + 1, k + 1 == corners ? 1 : k + 2});
    }
    // A disc of this radius around the vertex is inside of the fan at all times.
    const double inside = 0.05 * radius, speed = std::hypot(velocity.x, velocity.z);
    if (speed > 0) {
        f.begin = static_cast<float>(std::max(0.0, t - inside / speed));
        f.end = static_cast<float>(std::min(1.0, t + inside / speed));
    }
    return f;
}

/// The part of the time from begin to end in which no range of the list is there.
double uncovered(std::span<const depth_time_range<float>> list, float begin, float end)
{
    std::vector<depth_time_range<float>> sorted(list.begin(), list.end());
    std::ranges::sort(sorted, {}, &depth_time_range<float>::t0);
    double missing = 0;
    float reached = begin;
    for (const auto& r : sorted) {
        if (r.t0 > reached) missing += double(std::min(r.t0, end)) - double(std::min(reached, end));
        reached = std::max(reached, r.t1);
    }
    return missing + std::max(0.0, double(end) - double(reached));
}

} // namespace

TEST_CASE("fans of triangles around a vertex on a texel's centre, or near it, leave no crack")
{
    bit_source bits(71);
    range_rasterizer rasterize;
    for (const fan_motion how : {fan_motion::at_rest, fan_motion::carried, fan_motion::deforming}) {
        int cracks = 0;
        double overlap = 0;
        const auto fans = effort(3000);
        for (std::int64_t i = 0; i < fans; ++i) {
            const fan f = any_fan(bits, how);
            const range_lists& lists = rasterize(world_of({f.part}), light_above(), world_size, world_size);
            const auto list = lists.map()(std::size_t(f.x), std::size_t(f.y));
            cracks += uncovered(list, f.begin, f.end) > 0;
            double lasting = 0;
            for (const auto& r : list) lasting += double(range_duration(r));
            if (how == fan_motion::carried) overlap = std::max(overlap, lasting - 1);
        }
        INFO(int(how));
        CHECK(cracks == 0);
        // Carried, triangles overlap for the time in which the vertex is within rounding of the centre.
        if (how == fan_motion::carried) CHECK(overlap > 0);
    }
}

TEST_CASE("samples find a triangle of the fan at every time")
{
    bit_source bits(72);
    constexpr int samples = 8;
    int asked = 0;
    for (int i = 0; i < 300; ++i) {
        const fan f = any_fan(bits, fan_motion(i % 3));
        const sample_picture picture = rasterize_samples(world_of({f.part}), light_above(), world_size, world_size,
                                                         {.samples = samples, .pattern = sample_pattern::centres});
        for (const stochastic_sample<float>& seen : picture.map()(std::size_t(f.x), std::size_t(f.y))) {
            if (!(f.begin <= seen.t && seen.t <= f.end)) continue;
            ++asked;
            REQUIRE(seen.id >= 0);
        }
    }
    CHECK(asked > 300);
}

TEST_CASE("a quad that passes the near or the far plane is there for a part of the time, at an uncut depth")
{
    range_rasterizer rasterize;
    for (const float tolerance : {0.f, 1e-4f})
        for (const bool leaves : {false, true})
            for (const float plane : {1.f, -1.f}) { // y of the near and of the far plane
                // At t = 0.69 it passes the plane.
                const float inside = 0.25f * plane, way = leaves ? 1 / 0.69f : 1 / 0.31f;
                const float from = leaves ? inside : plane + (plane - inside) * 0.69f * way;
                const float to = leaves ? plane + (plane - inside) * 0.31f * way : inside;
                const auto part = sheet({8, from, 8}, {56, from, 56}, {0, to - from, 0});
                const range_lists& lists =
                    rasterize(world_of({part}), light_above(), world_size, world_size, {.depth_tolerance = tolerance});
                const auto list = lists.map()(20, 30);
                REQUIRE(list.size() == 1);
                const auto& r = list[0];
                CHECK(r.t0 == doctest::Approx(leaves ? 0 : 0.69).epsilon(1e-6));
                CHECK(r.t1 == doctest::Approx(leaves ? 0.69 : 1).epsilon(1e-6));
                CHECK(double(r.z0) == doctest::Approx(-double(leaves ? inside : plane)).epsilon(1e-6));
                CHECK(double(r.z1) == doctest::Approx(-double(leaves ? plane : inside)).epsilon(1e-6));
            }
}

// A triangle whose corners pass both planes at times of their own: at every texel against its depth in double.
TEST_CASE("tilting triangles are cut where they pass the planes, in perspective too")
{
    bit_source bits(73);
    const auto real = [&](double low, double high) { return static_cast<float>(bits.uniform(low, high)); };
    range_rasterizer rasterize;
    int cut = 0, asked = 0;
    for (int i = 0; i < int(effort(400)); ++i) {
        moving_camera light = light_above();
        if (i % 2 == 1)
            light.open = {.kind = projection::perspective,
                          .position = {32, 2, 32},
                          .right = {1, 0, 0},
                          .up = {0, 0, -1},
                          .forward = {0, -1, 0},
                          .half_extent = {16, 16},
                          .near_distance = 1,
                          .far_distance = 3};
        moving_part part;
        for (int k = 0; k < 3; ++k)
            part.add({real(0, 64), real(-1.8, 2.6), real(0, 64)},
                     {real(0, 64), real(-1.8, 2.6), real(0, 64)}); // the light is at 2
        part.open.triangles = {{0, 1, 2}};
        const range_lists& lists =
            rasterize(world_of({part}), light, world_size, world_size, {.depth_tolerance = 1e-4f});
        for (int k = 0; k < 400; ++k) {
            const std::size_t x = bits.below(64), y = bits.below(64);
            const double t = bits.uniform(0, 1);
            std::array<glm::dvec4, 3> p;
            for (std::size_t v = 0; v < 3; ++v)
                p[v] = texel_space(light.open, {64, 64},
                                   (1 - t) * glm::dvec3(part.open.positions[v]) + t * glm::dvec3(part.closing[v]));
            std::array<double, 3> e;
            for (std::size_t v = 0; v < 3; ++v) {
                const glm::dvec4 &a = p[(v + 1) % 3], &b = p[(v + 2) % 3];
                const double s_x = double(x) + 0.5, s_y = double(y) + 0.5;
                e[v] = (a.x - s_x * a.w) * (b.y - s_y * b.w) - (a.y - s_y * a.w) * (b.x - s_x * b.w);
            }
            const double sum = e[0] + e[1] + e[2], least = std::min({e[0] / sum, e[1] / sum, e[2] / sum});
            if (std::abs(least) < 1e-3) continue; // beside an edge
            const double z = (e[0] * p[0].z + e[1] * p[1].z + e[2] * p[2].z) / sum;
            if (std::abs(std::abs(z) - 1) < 1e-3) continue;
            int found = 0;
            for (const auto& r : lists.map()(x, y)) found += r.t0 <= float(t) && float(t) < r.t1;
            ++asked;
            cut += least > 0 && std::abs(z) > 1;
            REQUIRE(found == int(least > 0 && std::abs(z) < 1));
        }
    }
    CHECK(asked > effort(400) * 200);
    CHECK(cut > effort(400));
}

TEST_CASE("the moving rasterizer refuses places that are not finite, and more triangles than float has numbers for")
{
    range_rasterizer rasterize;
    auto part = sheet({8, 0, 8}, {56, 0, 56});
    part.closing[2].y = std::numeric_limits<float>::quiet_NaN();
    CHECK_THROWS_WITH_AS(rasterize(world_of({sheet({8, 0, 8}, {56, 0, 56}), part}), light_above(), 8, 8),
                         "moving rasterizer: vertex 2 of mesh 1 is not at a finite place", std::invalid_argument);
    auto many = sheet({8, 0, 8}, {56, 0, 56});
    many.open.triangles.resize((1 << 24) + 1, {0, 1, 2});
    CHECK_THROWS_AS(rasterize(world_of({many}), light_above(), 8, 8), std::invalid_argument);
}
