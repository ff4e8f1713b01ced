// The rasterizer of motion against edge functions in double precision, for one texel, one triangle and one time at a
// time. Threads, budgets and tiles do not change its lists.
#include "renderer/raster/moving_rasterizer.hpp"

#include "moving_boxes.hpp"
#include "renderer/raster/moving_tiles.hpp"

#include <gnomon/motion/triangle/moving_triangle.h>

#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

using namespace gnomon;
using namespace gnomon::renderer;
using namespace gnomon::test;

namespace {

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
            // Distance of the sample from the edge, in texels.
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

TEST_CASE("ranges cover the times and depths that edge functions give")
{
    constexpr int width = 75, height = 50;
    for (const bool perspective : {false, true})
        for (const bool turn : {false, true}) {
            const moving_scene world = moving_boxes(1, 6, turn);
            const moving_camera light = light_of(world, perspective);
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

TEST_CASE("lists do not depend on the number of threads, nor resolved lists on the budget")
{
    const moving_scene world = moving_boxes(4, 40);
    const moving_camera light = light_of(world, true);
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

TEST_CASE("work grows with covered texels: eight times the motion tests hardly more texels for each covered one")
{
    const auto tested_per_pair = [](float factor) {
        moving_scene world = moving_boxes(6, 30);
        for (std::size_t i = 0; i < world.closing[0].size(); ++i)
            world.closing[0][i] = world.open.meshes[0].positions[i] + factor * glm::vec3(0.3f, 0.02f, 0.25f);
        const moving_camera light{light_of(moving_boxes(6, 0), true).open};
        range_rasterizer rasterize;
        const range_counts counts = rasterize(world, light, 256, 256).counts;
        return double(counts.tested) / double(counts.pairs);
    };
    CHECK(tested_per_pair(1) < 2);
    CHECK(tested_per_pair(8) < 2.5);
}

TEST_CASE("impossible sizes of pictures are refused")
{
    const moving_scene world = moving_boxes(9, 0);
    range_rasterizer rasterize;
    CHECK_THROWS_WITH_AS(rasterize(world, light_of(world, false), 0, 5),
                         "moving rasterizer: 0x5 texels, 1 to 16384 per side are possible", std::invalid_argument);
}

TEST_CASE("triangle numbers count through the meshes")
{
    const moving_scene world = moving_boxes(10, 1);
    const triangle_numbers numbers(world.open);
    CHECK(numbers.count() == 14);
    CHECK(numbers[0].mesh == 0);
    CHECK(numbers[11].triangle == 11);
    CHECK(numbers[12].mesh == 1);
    CHECK(numbers[13].triangle == 1);
}
