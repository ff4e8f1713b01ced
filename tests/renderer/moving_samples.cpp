// The stochastic rasterizer against rays at the place and time of each sample; strata, seeds and threads.
#include "renderer/raster/moving_samples.hpp"

#include "moving_boxes.hpp"
#include "renderer/raster/moving_rasterizer.hpp"
#include "renderer/trace/tracer.hpp"
#include "support/effort.hpp"

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <rapidcheck.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <stdexcept>
#include <vector>

using namespace gnomon;
using namespace gnomon::renderer;
using namespace gnomon::test;

namespace {

bool same(const sample_picture& a, const sample_picture& b)
{
    return a.of.size() == b.of.size() && std::memcmp(a.of.data(), b.of.data(), a.of.size() * sizeof a.of[0]) == 0;
}

// Numbers of n values in [0, 1), in ascending order, one in each of n equal strata, up to rounding.
bool one_in_each_stratum(std::vector<double> values)
{
    std::ranges::sort(values);
    const double n = double(values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
        if (!(values[i] * n >= double(i) - 1e-3 && values[i] * n <= double(i) + 1 + 1e-3)) return false;
    return true;
}

} // namespace

TEST_CASE("a sample has the depth, id and motion of the first hit of a ray at its place and time")
{
    constexpr int width = 75, height = 50;
    const glm::dvec2 size(width, height);
    for (const bool perspective : {false, true})
        for (const sample_pattern pattern :
             {sample_pattern::stratified, sample_pattern::even, sample_pattern::centres}) {
            CAPTURE(perspective);
            const moving_scene world = moving_boxes(1, 6);
            moving_camera light = light_of(world, perspective);
            light.motion = {0.5, 0.3, -0.4};
            light.open.near_distance *= 0.8, light.open.far_distance *= 1.1;
            const sample_picture drawn =
                rasterize_samples(world, light, width, height, {.seed = 3, .pattern = pattern});
            const tracer rays(world);
            const triangle_numbers numbers(world.open);
            int surfaces = 0, moved = 0, apart = 0;
            for (const stochastic_sample<float>& s : drawn.of) {
                const camera now = light.at(double(s.t));
                const hit seen = rays.first_hit(ray_through(now, glm::dvec2(s.x, s.y) / size), s.t);
                const bool inside = seen.valid() && within_view(project(now, seen.position));
                if (inside != (s.id >= 0)) {
                    ++apart;
                    continue;
                }
                if (!inside) {
                    REQUIRE((s.z == 1 && s.d_x == 0 && s.d_y == 0 && s.d_z == 0));
                    continue;
                }
                const triangle_place place = numbers[std::uint32_t(s.id)];
                if (int(place.mesh) != seen.mesh || place.triangle != seen.triangle) {
                    ++apart;
                    continue;
                }
                ++surfaces;
                const receiver_motion point = rays.receiver_of(seen, s.t);
                const glm::dvec3 open = project(light.at(0), point.open.position),
                                 close = project(light.at(1), point.closing.position);
                const glm::dvec2 d = size * glm::dvec2(close - open);
                // Where a ray grazes a triangle, rounding moves its hit.
                const glm::vec3 towards = direction_towards(now, glm::dvec3(seen.position));
                const double tolerance = 5e-4 / double(std::abs(glm::dot(towards, seen.normal)));
                REQUIRE(std::abs(double(s.z) - linear_depth(now, view_distance(now, seen.position))) <
                        0.02 * tolerance);
                REQUIRE(std::abs(double(s.d_x) - d.x) < tolerance);
                REQUIRE(std::abs(double(s.d_y) - d.y) < tolerance);
                REQUIRE(std::abs(double(s.d_z) - (close.z - open.z)) < 0.1 * tolerance);
                moved += glm::length(d) > 2;
            }
            CHECK(surfaces > int(drawn.of.size()) / 3);
            CHECK(moved > surfaces / 10);
            CHECK(apart < surfaces / 500);
        }
}

TEST_CASE("times, columns, rows and cells of a texel hold one sample each")
{
    const moving_scene world = moving_boxes(2, 1);
    const moving_camera light = light_of(world, false);
    CHECK(rc::check("strata are used once", [&] {
        const int samples = *rc::gen::inRange(1, 41);
        const auto seed = *rc::gen::arbitrary<std::uint32_t>();
        const sample_picture drawn = rasterize_samples(world, light, 5, 4, {samples, seed});
        int columns = int(std::sqrt(samples));
        while (samples % columns != 0) --columns;
        for (std::size_t y = 0; y < 4; ++y)
            for (std::size_t x = 0; x < 5; ++x) {
                std::vector<double> across, down, cells;
                bool clear = true; // of rounding: no sample is at the border of a cell
                const auto texel = drawn.map()(x, y);
                for (std::size_t k = 0; k < texel.size(); ++k) {
                    const double u = double(texel[k].x) - double(x), v = double(texel[k].y) - double(y);
                    RC_ASSERT(u >= 0 && u < 1 && v >= 0 && v < 1);
                    RC_ASSERT(slice_of(texel[k].t, float(samples)) == float(k));
                    across.push_back(u), down.push_back(v);
                    const int rows = samples / columns;
                    for (const double place : {u * columns, v * rows})
                        clear = clear && std::abs(place - std::round(place)) > 1e-5;
                    cells.push_back((std::floor(v * rows) * columns + std::floor(u * columns) + 0.5) / samples);
                }
                RC_ASSERT(one_in_each_stratum(across) && one_in_each_stratum(down));
                RC_ASSERT(!clear || one_in_each_stratum(cells));
            }
    }));
}

// Means over many samples against those of independent uniform numbers: 5 standard errors.
TEST_CASE("place, time and the samples of other seeds are independent of one another")
{
    const moving_scene world = moving_boxes(2, 1);
    const moving_camera light = light_of(world, false);
    constexpr int size = 128, samples = 4;
    for (const sample_pattern pattern : {sample_pattern::stratified, sample_pattern::jittered}) {
        const auto with = [&](std::uint32_t seed) {
            return rasterize_samples(world, light, size, size, {samples, seed, pattern});
        };
        const sample_picture one = with(0), other = with(1);
        CHECK(same(one, with(0)));
        // Correlations of the jitter within strata, and of places with times and with neighbours.
        double place_and_time = 0, seeds = 0, times = 0, neighbours = 0, x_and_y = 0;
        const auto fraction = [](double x) { return x - std::floor(x) - 0.5; };
        for (std::size_t i = 0; i < one.of.size(); ++i) {
            const auto &a = one.of[i], &b = other.of[i], &c = one.of[(i + samples) % one.of.size()];
            const double time = fraction(samples * double(a.t));
            place_and_time += fraction(double(a.x)) * (double(a.t) - 0.5);
            x_and_y += fraction(double(a.x)) * fraction(double(a.y));
            seeds += fraction(double(a.x)) * fraction(double(b.x));
            times += time * fraction(samples * double(b.t));
            neighbours += time * fraction(samples * double(c.t));
        }
        const double most = 5.0 / 12 * std::sqrt(double(one.of.size()));
        for (const double sum : {place_and_time, seeds, times, neighbours, x_and_y}) CHECK(std::abs(sum) < most);
    }
}

TEST_CASE("even times fill their strata over few texels, by another shift for each seed")
{
    const moving_scene world = moving_boxes(3, 0);
    const moving_camera light = light_of(world, false);
    constexpr std::size_t size = 64, window = 6, samples = 2;
    const auto squares_of_means = [&](sample_pattern pattern, std::uint32_t seed) {
        const sample_picture drawn =
            rasterize_samples(world, light, int(size), int(size), {int(samples), seed, pattern});
        double squares = 0;
        for (std::size_t y = 0; y + window <= size; ++y)
            for (std::size_t x = 0; x + window <= size; ++x) {
                double mean = 0;
                for (std::size_t i = 0; i < window * window; ++i)
                    mean += double(drawn.map()(x + i % window, y + i / window)[1].t) - 0.75;
                squares += mean * mean;
            }
        return squares;
    };
    for (const std::uint32_t seed : {1u, 2u, 3u})
        CHECK(squares_of_means(sample_pattern::even, seed) < 0.25 * squares_of_means(sample_pattern::stratified, seed));
    const auto time = [&](std::uint32_t seed) {
        return rasterize_samples(world, light, 1, 1, {.seed = seed, .pattern = sample_pattern::even}).of[0].t;
    };
    CHECK(std::abs(time(1) - time(2)) > 1e-4f);
}

TEST_CASE("samples do not depend on the number of threads, nor those of a texel on the size of the picture")
{
    const moving_scene world = moving_boxes(4, 40);
    const moving_camera light = light_of(world, true);
    const sample_picture many = rasterize_samples(world, light, 100, 90);
    {
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        CHECK(same(many, rasterize_samples(world, light, 100, 90)));
    }
    const sample_picture few = rasterize_samples(world, light, 33, 40);
    for (std::size_t y = 0; y < 40; ++y)
        for (std::size_t x = 0; x < 33; ++x)
            for (std::size_t k = 0; k < 4; ++k) {
                REQUIRE(many.map()(x, y)[k].x == few.map()(x, y)[k].x);
                REQUIRE(many.map()(x, y)[k].t == few.map()(x, y)[k].t);
            }
}

TEST_CASE("impossible samples are refused, and a map's arrays are counted")
{
    const moving_scene world = moving_boxes(9, 0);
    const moving_camera light = light_of(world, false);
    CHECK_THROWS_WITH_AS(rasterize_samples(world, light, 5, 5, {.samples = 0}),
                         "moving samples: 0 samples, 1 to 65536 are possible", std::invalid_argument);
    CHECK_THROWS_WITH_AS(rasterize_samples(world, light, 0, 5),
                         "moving rasterizer: 0x5 texels, 1 to 16384 per side are possible", std::invalid_argument);
    const sample_picture drawn = rasterize_samples(world, light, 3, 2);
    CHECK_NOTHROW(check_shape(drawn.map(), "test"));
    sample_map<float> map = drawn.map();
    map.samples = 5;
    CHECK_THROWS_WITH_AS(check_shape(map, "test"),
                         "gnomon: test: map.of.size() is 24, but map.width map.height map.samples is 30",
                         std::invalid_argument);
    map.samples = 0;
    CHECK_THROWS_AS(check_shape(map, "test"), std::invalid_argument);
    map = drawn.map(), map.width = ~std::size_t(0);
    CHECK_THROWS_AS(check_shape(map, "test"), std::invalid_argument);
}
