// The rasterizer of motion against edge functions in double precision, asked one texel, one triangle and one time at a
// time; and what must not change its lists: threads, budgets, tiles.
#include "renderer/raster/moving_rasterizer.hpp"

#include "renderer/raster/moving_tiles.hpp"
#include "renderer/shade/moving_view.hpp"
#include "support/hostile.hpp"

#include <gnomon/motion/triangle/moving_triangle.h>

#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

using namespace gnomon;
using namespace gnomon::renderer;
using gnomon::test::bit_source;

namespace {

// Boxes that move, and turn or do not, at random, and a ground.
moving_scene any_scene(std::uint64_t seed, int boxes, bool turn = true)
{
    bit_source bits(seed);
    const auto real = [&](double low, double high) { return static_cast<float>(bits.uniform(low, high)); };
    const auto point = [&](double reach) {
        return glm::vec3(real(-reach, reach), real(0, reach), real(-reach, reach));
    };
    moving_scene world{{"boxes", {}}, {}};
    mesh open{}, close{};
    for (int i = 0; i < boxes; ++i) {
        const glm::vec3 size(real(0.1, 1)), at = point(2);
        const float angle = real(-1, 1);
        add_box(open, upright(at, size, angle));
        add_box(close, upright(at + 0.5f * point(2), size, turn ? real(-1, 1) : angle));
    }
    world.open.meshes = {open, ground({0, 0, 0}, 8, 8, glm::vec3(0.5f))};
    world.closing = {close.positions, world.open.meshes[1].positions};
    return world;
}

moving_camera any_light(const moving_scene& world, bool perspective)
{
    const auto corners = bounds_of(world).corners();
    if (perspective) return {perspective_view_from({3, 7, 2}, {0, 0, 0}, corners, glm::radians(60.0), 1), {0, 0, 0}};
    return {orthographic_view(corners, {0.4, -1, 0.3})};
}

// Every triangle at every time, by homogeneous edge functions in double.
class reference {
  public:
    reference(const moving_scene& world, const moving_camera& eye, int width, int height)
    {
        const glm::dvec2 size(width, height);
        for (std::size_t m = 0; m < world.open.meshes.size(); ++m)
            for (const glm::uvec3& t : world.open.meshes[m].triangles) {
                const auto vertex = [&](std::uint32_t i) {
                    const glm::dvec4 q = texel_space(eye.open, size, world.open.meshes[m].positions[i]);
                    const glm::dvec4 r = texel_space(eye.at(1), size, world.closing[m][i]);
                    return moving_vertex<double>{q.x, q.y, q.z, q.w, r.x, r.y, r.z, r.w};
                };
                triangles_.push_back({vertex(t.x), vertex(t.y), vertex(t.z)});
            }
    }

    std::size_t size() const { return triangles_.size(); }

    struct sight {
        bool covered, decided;
        double depth;
    };
    sight at(std::size_t triangle, double x, double y, double t) const
    {
        const moving_triangle<double>& m = triangles_[triangle];
        std::array<glm::dvec4, 3> p;
        double least_length = std::numeric_limits<double>::infinity();
        for (std::size_t k = 0; k < 3; ++k) {
            const moving_vertex<double>& v = k == 0 ? m.a : k == 1 ? m.b : m.c;
            p[k] = glm::mix(glm::dvec4(v.x0, v.y0, v.z0, v.w0), glm::dvec4(v.x1, v.y1, v.z1, v.w1), t);
        }
        std::array<double, 3> e;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec4 &i = p[(k + 1) % 3], &j = p[(k + 2) % 3];
            const glm::dvec2 a(i.x - x * i.w, i.y - y * i.w), b(j.x - x * j.w, j.y - y * j.w);
            e[k] = a.x * b.y - a.y * b.x;
            // How far the sample is from the edge, in texels.
            const double distance = std::abs(e[k]) / (i.w * j.w) / std::max(glm::length(a / i.w - b / j.w), 1e-9);
            least_length = std::min(least_length, distance);
        }
        const double sum = e[0] + e[1] + e[2];
        const bool covered = (e[0] > 0 && e[1] > 0 && e[2] > 0) || (e[0] < 0 && e[1] < 0 && e[2] < 0);
        return {covered, least_length > 0.02, (e[0] * p[0].z + e[1] * p[1].z + e[2] * p[2].z) / sum};
    }

  private:
    std::vector<moving_triangle<double>> triangles_;
};

template <class Lists> bool same_lists(const Lists& a, const Lists& b)
{
    const auto equal = [](const depth_time_range<float>& r, const depth_time_range<float>& s) {
        return r.t0 == s.t0 && r.t1 == s.t1 && r.z0 == s.z0 && r.z1 == s.z1 && r.id == s.id;
    };
    return a.first == b.first && std::ranges::equal(a.ranges, b.ranges, equal);
}

} // namespace

TEST_CASE("ranges are where edge functions say, at the right depth")
{
    constexpr int width = 75, height = 50;
    for (const bool perspective : {false, true})
        for (const bool turn : {false, true}) {
            const moving_scene world = any_scene(1, 6, turn);
            const moving_camera light = any_light(world, perspective);
            range_rasterizer rasterize;
            const range_lists& lists = rasterize(world, light, width, height, {.depth_tolerance = 1e-4f});
            const reference exact(world, light, width, height);
            bit_source bits(2);
            int decided = 0, covered = 0;
            for (int i = 0; i < 6000; ++i) {
                const std::size_t x = bits.below(width), y = bits.below(height);
                const auto t = static_cast<float>(bits.uniform(0, 1));
                std::vector<int> found(exact.size());
                std::vector<float> depth(exact.size());
                for (const auto& r : lists.map()(x, y))
                    if (r.t0 <= t && t < r.t1) {
                        ++found[std::size_t(r.id)];
                        depth[std::size_t(r.id)] = range_depth(r, t);
                    }
                for (std::size_t k = 0; k < exact.size(); ++k) {
                    const auto seen = exact.at(k, double(x) + 0.5, double(y) + 0.5, double(t));
                    if (!seen.decided) continue;
                    ++decided;
                    REQUIRE(found[k] == int(seen.covered));
                    if (!seen.covered) continue;
                    ++covered;
                    REQUIRE(double(depth[k]) == doctest::Approx(seen.depth).epsilon(5e-4));
                }
            }
            CHECK(covered > 2000);
            CHECK(decided > 6000 * int(exact.size()) * 9 / 10);
        }
}

// The time for which two neighbours may be there together, on average: both are widened by 2^-19 of their size in a
// tile, some 20 texels, and go one texel or more in the time.
constexpr double shared_time = 2 * 20 * 0x1p-19;

TEST_CASE("neighbours leave no crack: a texel sees one triangle of the ground until the next is there")
{
    const moving_scene world = any_scene(3, 0);
    const moving_camera light{any_light(world, true).open, {0.7, 0.4, -0.3}};
    range_rasterizer rasterize;
    const range_lists& lists = rasterize(world, light, 256, 256);
    int shared = 0;
    double together = 0;
    for (std::size_t i = 0; i < 256 * 256; ++i) {
        const auto list = lists.map()(i % 256, i / 256);
        REQUIRE(list.size() <= 2);
        if (list.size() < 2) continue;
        ++shared;
        const float begin = std::max(list[0].t0, list[1].t0), end = std::min(list[0].t1, list[1].t1);
        REQUIRE(begin <= end);
        together += double(end - begin);
    }
    CHECK(shared > 100);
    CHECK(together < shared_time * shared);
}

// A sheet across the light's axis, beyond the picture on all sides, of which one half is carried and the other creased.
TEST_CASE("neighbours leave no crack where one is translated and the other is not")
{
    constexpr int side = 9, size = 128;
    bit_source bits(11);
    const auto real = [&] { return static_cast<float>(bits.uniform(-0.3, 0.3)); };
    mesh open;
    std::vector<glm::vec3> closing;
    for (int z = 0; z < side; ++z)
        for (int x = 0; x < side; ++x) {
            const glm::vec3 at(float(x - side / 2), 0, float(z - side / 2));
            open.positions.push_back(at);
            closing.push_back(at + (x < side / 2 ? glm::vec3(0.3f, 0.1f, -0.2f) : glm::vec3(real(), 0.1f, real())));
        }
    for (unsigned z = 0; z + 1 < side; ++z)
        for (unsigned x = 0; x + 1 < side; ++x) {
            const unsigned i = z * side + x;
            open.triangles.push_back({i, i + 1, i + side});
            open.triangles.push_back({i + 1, i + side + 1, i + side});
        }
    const moving_scene world{{"sheet", {open}}, {closing}};
    const std::array<glm::vec3, 2> seen{glm::vec3(-2, -0.5f, -2), glm::vec3(2, 0.5f, 2)};
    const moving_camera light{perspective_view_from({0.2, 7, 0.1}, {0, 0, 0}, seen, glm::radians(30.0), 1)};

    int linear = 0, mixed = 0;
    const tiled_triangles scenery(world, light, size, size, faces::both);
    for (std::size_t tile = 0; tile < scenery.tiles(); ++tile)
        scenery.for_each(tile, [&](const moving_setup& s) {
            linear += s.linear;
            mixed += glm::any(s.linear_edges) && !s.linear;
        });
    CHECK(linear > 0);
    CHECK(mixed > 0);

    range_rasterizer rasterize;
    const range_lists& lists = rasterize(world, light, size, size);
    std::size_t shared = 0;
    double together = 0;
    for (std::size_t i = 0; i < std::size_t(size) * size; ++i) {
        const auto list = lists.map()(i % size, i / size);
        std::vector<depth_time_range<float>> sorted(list.begin(), list.end());
        std::ranges::sort(sorted, {}, &depth_time_range<float>::t0);
        REQUIRE(!sorted.empty());
        REQUIRE(sorted.front().t0 == 0);
        REQUIRE(sorted.back().t1 == 1);
        for (std::size_t k = 1; k < sorted.size(); ++k) {
            REQUIRE(sorted[k].t0 <= sorted[k - 1].t1);
            together += double(sorted[k - 1].t1 - sorted[k].t0);
        }
        shared += sorted.size() - 1;
    }
    CHECK(shared > std::size_t(size) * size / 4);
    CHECK(together < shared_time * double(shared));
}

TEST_CASE("lists do not depend on threads, and resolved ones not on the budget")
{
    const moving_scene world = any_scene(4, 40);
    const moving_camera light = any_light(world, true);
    range_rasterizer rasterize;
    const range_lists many = rasterize(world, light, 100, 90),
                      resolved = rasterize(world, light, 100, 90, {.resolved = true});
    CHECK(many.counts.pairs > 100 * 90);
    CHECK(many.ranges.size() > resolved.ranges.size());
    CHECK(many.counts.early_resolves == 0);
    {
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        CHECK(same_lists(many, rasterize(world, light, 100, 90)));
    }
    const range_lists cramped = rasterize(world, light, 100, 90, {.resolved = true, .budget = 30 * texel_pack::size});
    CHECK(cramped.counts.early_resolves > 0);
    CHECK(cramped.counts.pairs == many.counts.pairs);
    // Cut lines are rounded, so depths, and with them crossings, move in the last places.
    bit_source bits(5);
    int different = 0;
    for (int i = 0; i < 20'000; ++i) {
        const std::size_t x = bits.below(100), y = bits.below(90);
        const auto t = static_cast<float>(bits.uniform(0, 1));
        const auto front = [&](const range_lists& lists) {
            float nearest = 2;
            for (const auto& r : lists.map()(x, y))
                if (r.t0 <= t && t < r.t1) nearest = std::min(nearest, range_depth(r, t));
            return nearest;
        };
        const float expected = front(many);
        different += std::abs(front(resolved) - expected) > 1e-5f;
        different += std::abs(front(cramped) - expected) > 1e-5f;
    }
    CHECK(different <= 2);
}

TEST_CASE("work grows with what is covered: eight times the motion tests no more texels for each that it covers")
{
    const auto tested_per_pair = [](float factor) {
        moving_scene world = any_scene(6, 30);
        for (std::size_t i = 0; i < world.closing[0].size(); ++i)
            world.closing[0][i] = world.open.meshes[0].positions[i] + factor * glm::vec3(0.3f, 0.02f, 0.25f);
        const moving_camera light{any_light(any_scene(6, 0), true).open};
        range_rasterizer rasterize;
        const range_counts counts = rasterize(world, light, 256, 256).counts;
        return double(counts.tested) / double(counts.pairs);
    };
    CHECK(tested_per_pair(1) < 2);
    CHECK(tested_per_pair(8) < 2.5);
}

TEST_CASE("the camera's segments are what instants see")
{
    const moving_scene world = any_scene(7, 8);
    const camera eye = perspective_view_from({2, 5, 6}, {0, 0, 0}, bounds_of(world).corners(), glm::radians(45.0), 1.5);
    constexpr int width = 60, height = 40, samples = 16;
    const seen_motion analytic = camera_segments(world, eye, width, height, 1e-4f);
    const seen_motion stochastic = stochastic_visibility(world, eye, width, height, samples);
    int asked = 0, other = 0;
    for (std::size_t pixel = 0; pixel < std::size_t(width * height); ++pixel) {
        float whole = 0;
        for (const seen_segment& c : analytic(pixel)) whole += c.weight;
        CHECK(whole <= 1.0001f);
        for (const seen_segment& s : stochastic(pixel)) {
            CHECK(s.weight == 1.0f / samples);
            ++asked;
            bool same = false;
            for (const seen_segment& c : analytic(pixel)) {
                if (!(c.t0 <= s.t0 && s.t0 <= c.t1) || c.triangle != s.triangle) continue;
                const float passed = (s.t0 - c.t0) / std::max(c.t1 - c.t0, 1e-9f);
                same |= glm::distance(glm::mix(c.p0, c.p1, passed), s.p0) < 2e-3f;
            }
            other += !same;
        }
    }
    CHECK(asked > width * height * samples / 2);
    // At the ends of segments and where two surfaces meet, rounding decides.
    CHECK(other < asked / 500);
}

TEST_CASE("what is behind the eye or before the near plane is not seen")
{
    const moving_scene world = any_scene(8, 0);
    // Level, a little above the ground, in the midst of it.
    const camera eye =
        perspective_view_from({0, 0.5, 0}, {0, 0.5, -5}, bounds_of(world).corners(), glm::radians(60.0), 1);
    const seen_motion seen = camera_segments(world, eye, 64, 64, 0);
    for (std::size_t pixel = 0; pixel < 64 * 64; ++pixel) {
        const std::size_t y = pixel / 64;
        if (y < 31) REQUIRE(seen(pixel).empty());
        if (y > 40) REQUIRE(!seen(pixel).empty());
        for (const seen_segment& c : seen(pixel)) REQUIRE(c.p0.y == doctest::Approx(0).epsilon(1e-3));
    }
}

TEST_CASE("the moving rasterizer says which pictures are impossible")
{
    const moving_scene world = any_scene(9, 0);
    range_rasterizer rasterize;
    CHECK_THROWS_WITH_AS(rasterize(world, any_light(world, false), 0, 5),
                         "moving rasterizer: 0x5 texels, 1 to 16384 per side are possible", std::invalid_argument);
    CHECK_THROWS_AS(rasterize_instants(world, any_light(world, false), 5, 5, 0), std::invalid_argument);
}

TEST_CASE("triangle numbers count through the meshes")
{
    const moving_scene world = any_scene(10, 1);
    const triangle_numbers numbers(world.open);
    CHECK(numbers.count() == 14);
    CHECK(numbers[0].mesh == 0);
    CHECK(numbers[11].triangle == 11);
    CHECK(numbers[12].mesh == 1);
    CHECK(numbers[13].triangle == 1);
}
