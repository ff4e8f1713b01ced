// Maps of line samples: what a line through a texel sees is what rays through its points meet; where lines have less error
// than ranges in time, and where more.
#include "evaluation/motion/accumulation.hpp"
#include "evaluation/motion/line_maps.hpp"
#include "evaluation/motion/map_source.hpp"
#include "evaluation/motion/receivers/analytic.hpp"
#include "renderer/scene/moving_stages.hpp"
#include "renderer/trace/tracer.hpp"
#include "support/hostile.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace gnomon;
using namespace gnomon::evaluation;
using namespace gnomon::renderer;

namespace {

constexpr int resolution = 512, width = 160, height = 90, times = 256;

// The root mean square error of a picture's visibility, where a surface is seen all of the time.
double error_of(const reference_picture& traced, const seen_motion& seen, std::span<const float> visibility)
{
    const image<float> found = mean_visibility(seen, visibility);
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < found.pixels.size(); ++i) {
        if (seen(i).empty() || traced.coverage.pixels[i] < 1) continue;
        sum += std::pow(double(found.pixels[i]) - double(traced.visibility.pixels[i]), 2), ++count;
    }
    return std::sqrt(sum / count);
}

struct compared_errors {
    double ranges, lines, crossed;
    std::size_t bytes_of_ranges, bytes_of_crossed = 0;

    explicit compared_errors(const moving_stage& stage, int finer = 1)
    {
        const reference_picture traced = tracer(stage.world).photograph(stage.light, stage.eye, width, height, times);
        const seen_motion seen = camera_segments(stage.world, stage.eye, width, height, depth_tolerance);
        map_source maps(stage.world, stage.light, resolution * finer);
        const auto map = maps.map("resolved_ranges");
        std::vector<float> lit;
        for (const light_receiver& r : light_receivers_of(seen, stage.light, maps.resolution))
            lit.push_back(light_visibility(map->map(), r));
        ranges = error_of(traced, seen, lit), bytes_of_ranges = map->bytes;
        const auto by_lines = [&](line_look_up how) {
            const line_maps some = rasterize_lines(stage.world, stage.light, resolution, middle_times(16), how);
            bytes_of_crossed = some.bytes(); // of the last
            const seen_motion at_times = seen_at_times(seen, some.times);
            std::vector<float> visibility(at_times.segments.size());
            line_visibility(some, line_receivers_of(at_times, stage.light, some), how, visibility);
            return error_of(traced, at_times, visibility);
        };
        lines = by_lines(line_look_up::placed), crossed = by_lines(line_look_up::crossed);
    }
};

} // namespace

TEST_CASE("lines see what rays through their points meet")
{
    const moving_stage stage = random_cubes(16.0 / 9, 100, 0.5f);
    const tracer rays(stage.world);
    test::bit_source bits(81);
    std::size_t surfaces = 0, others = 0;
    constexpr std::size_t points = 2000;
    const line_maps lines = rasterize_lines(stage.world, stage.light, 128, {0.3f}, line_look_up::crossed);
    for (std::size_t i = 0; i < points; ++i) {
        const bool rows = bits.chance(0.5);
        const std::size_t x = bits.below(128), y = bits.below(128);
        const double place = bits.uniform(0, 1);
        const camera light = stage.light.at(double(0.3f));
        const glm::dvec2 at(double(x) + (rows ? place : 0.5), double(y) + (rows ? 0.5 : place));
        const hit met = rays.first_hit(ray_through(light, at / 128.0), 0.3f);
        double expected = 1, nearest = 1;
        if (met.valid()) expected = project(light, glm::dvec3(met.position)).z, ++surfaces;
        const range_lists& lists = rows ? lines.along_x[0] : lines.along_y[0];
        for (const depth_time_range<float>& r : lists.map()(x, y))
            if (double(r.t0) <= place && place <= double(r.t1))
                nearest = std::min(nearest, double(range_depth(r, float(place))));
        others += std::abs(nearest - expected) > 1e-3;
    }
    CHECK(surfaces > points / 4);
    CHECK_MESSAGE(others <= points / 500, others);
}

TEST_CASE("lines have less error than ranges where edges are sharp, and more where shadows are smooth")
{
    const compared_errors sharp(pillars(16.0 / 9)), smooth(crossed_quads(16.0 / 9));
    CHECK(sharp.lines < 0.75 * sharp.ranges);
    CHECK(sharp.crossed < 0.55 * sharp.ranges);
    CHECK(smooth.crossed > 3 * smooth.ranges);
}

TEST_CASE("where many small things move, a finer map of ranges has no more error in a third of the memory")
{
    const compared_errors found(random_cubes(16.0 / 9, 400, 0.5f), 2);
    CHECK(found.ranges < 1.05 * found.crossed);
    CHECK(3 * found.bytes_of_ranges < found.bytes_of_crossed);
}
