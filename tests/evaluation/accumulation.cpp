// Accumulated shadow maps by packs, against percentage-closer filtering texel by texel.
#include "evaluation/motion/accumulation.hpp"

#include "renderer/scene/moving_stages.hpp"

#include <gnomon/filters/percentage_closer.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

using namespace gnomon;
using namespace gnomon::evaluation;
using namespace gnomon::renderer;

namespace {

constexpr int resolution = 64;

// K look-ups of bilinear weights along each axis, in double.
double lit(const image<std::array<float, 1>>& depths, double x, double y, double depth, int look_ups)
{
    const double left = std::floor(x - 0.5 * look_ups), top = std::floor(y - 0.5 * look_ups);
    const auto weight = [&](double place, double first, int i) {
        const double share = place - 0.5 * look_ups - first;
        return (i == 0 ? 1 - share : i < look_ups ? 1 : share) / look_ups;
    };
    double shadow = 0;
    for (int j = 0; j <= look_ups; ++j)
        for (int i = 0; i <= look_ups; ++i) {
            const int column = int(left) + i, row = int(top) + j;
            const bool inside = column >= 0 && row >= 0 && column < resolution && row < resolution;
            if (inside && double(depths(column, row)[0]) < depth) shadow += weight(x, left, i) * weight(y, top, j);
        }
    return 1 - shadow;
}

} // namespace

TEST_CASE("receivers of accumulated maps see what the texels around them say")
{
    const moving_stage stage = random_cubes(1, 60, 1, 0.4f);
    const accumulated_maps maps = accumulate(stage.world, stage.light, resolution, middle_times(4));
    REQUIRE(maps.times == std::vector{0.125f, 0.375f, 0.625f, 0.875f});
    const seen_motion seen = renderer::camera_segments(stage.world, stage.eye, 48, 48, 1e-3f);
    const seen_motion at_times = seen_at_times(seen, maps.times);
    const auto receivers = accumulated_receivers_of(at_times, stage.light, maps);
    const auto all = light_receivers_of(at_times, stage.light, resolution);
    for (const int look_ups : {1, 3}) {
        std::vector<float> packed;
        accumulated_visibility(maps, receivers, packed, look_ups);
        const auto found = in_order_of_segments(receivers, packed, at_times.segments.size());
        REQUIRE(found.size() == all.size());
        int between = 0, away = 0;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const light_receiver& r = all[i];
            if (!(r.facing.begin < r.facing.end)) {
                CHECK(found[i] == 0);
                ++away;
                continue;
            }
            const float t = r.path.depth.t0;
            const auto at = receiver_path_at(r.path, t);
            const auto& depths = maps.depths[std::size_t(4 * t)];
            const double expected = lit(depths, double(at.x), double(at.y), double(r.path.depth.z0), look_ups);
            // Sixteen weights, whose texels' places are rounded to 2^-24 of the map's size.
            REQUIRE(std::abs(double(found[i]) - expected) < 16 * resolution * 0x1p-24);
            between += found[i] > 0 && found[i] < 1;
        }
        CHECK(between > 100);
        CHECK(away > 10);
    }
    std::vector<float> none;
    CHECK_THROWS_WITH_AS(accumulated_visibility(maps, receivers, none, 2),
                         "accumulation: 2 look-ups, 1 and 3 are possible", std::invalid_argument);
}

TEST_CASE("interleaved maps give a static receiver the mean over the maps")
{
    const moving_stage stage = random_cubes(1, 60, 1, 0.4f);
    for (const int count : {4, 20}) {
        const accumulated_maps maps = accumulate(stage.world, stage.light, resolution, middle_times(count));
        const interleaved_maps together = interleave(maps);
        seen_motion seen{1, 1, {0}, {}};
        const glm::vec3 up(0, 1, 0);
        for (int i = 0; i < 400; ++i) {
            const glm::vec3 p(0.4f * float(i % 20) - 4, 0, 0.4f * float(i / 20) - 4);
            seen.segments.push_back({0, 1, 1, 1u << 20, p, p, up, up});
        }
        std::vector<static_place> receivers;
        for (const light_receiver& r : light_receivers_of(seen, stage.light, resolution))
            receivers.push_back({r.path.x0 / r.path.w0, r.path.y0 / r.path.w0, r.path.depth.z0});
        receivers.push_back({-0.2f, 3.5f, 1}), receivers.push_back({resolution + 9.f, 3.5f, 1}); // half and all outside
        std::vector<float> found(receivers.size());
        static_visibility(together, receivers, found);
        int between = 0;
        for (std::size_t i = 0; i < receivers.size(); ++i) {
            const static_place& r = receivers[i];
            double expected = 0;
            for (const auto& depths : maps.depths)
                expected += lit(depths, double(r.x), double(r.y), double(r.depth), 1) / count;
            REQUIRE(std::abs(double(found[i]) - expected) < 4 * resolution * 0x1p-24 + count * 0x1p-24);
            between += found[i] > 0 && found[i] < 1;
        }
        CHECK(between > 50);
    }
}
