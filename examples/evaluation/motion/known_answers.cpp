#include "known_answers.hpp"

#include "evaluation/core/timing.hpp"
#include "light_receivers.hpp"
#include "range_maps.hpp"
#include "renderer/scene/moving_stages.hpp"
#include "shadow_tests.hpp"

#include <glm/vec3.hpp>

#include <string>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

constexpr std::uint32_t nobody = 1u << 20;

report_row row_of(const moving_stage& scenery, const seen_motion& seen, const std::vector<float>& expected,
                  const motion_sizes& size)
{
    const range_shadow_map map = resolved_ranges(scenery.world, scenery.light, size.map_resolution);
    const std::vector<light_receiver> receivers = light_receivers_of(seen, scenery.light, size.map_resolution);
    std::vector<float> found(receivers.size());
    const double spent = least_seconds([&] {
        for (std::size_t i = 0; i < found.size(); ++i) found[i] = light_visibility(map.map(), receivers[i]);
    });
    return {.scene = scenery.world.open.name,
            .method = map.method + ", receivers analytic",
            .format = map.format,
            .reference = "closed-form",
            .receivers = static_cast<long long>(found.size()),
            .bytes_per_texel = map.bytes_per_texel(),
            .errors = compare(found, expected),
            .ns_per_receiver = 1e9 * spent / double(found.size()),
            .build_ms = map.build_ms};
}

// Where the rays through the texels' centres meet the ground, for the whole shutter interval.
report_row trapezoid_row(const motion_sizes& size)
{
    const moving_stage scenery = trapezoid(double(size.width) / size.height);
    const int resolution = size.map_resolution;
    seen_motion seen{resolution, resolution, {0}, {}};
    std::vector<float> expected;
    for (int y = 0; y < resolution; ++y)
        for (int x = 0; x < resolution; ++x) {
            const view_ray ray = ray_through(scenery.light.open, (glm::dvec2(x, y) + 0.5) / double(resolution));
            const glm::dvec3 point = ray.origin - ray.origin.y / ray.direction.y * ray.direction;
            const glm::vec3 p(point), up(0, 1, 0);
            seen.segments.push_back({0, 1, 1, nobody, p, p, up, up});
            expected.push_back(static_cast<float>(trapezoid_visibility(point)));
        }
    return row_of(scenery, seen, expected, size);
}

report_row lit_ramp_row(const motion_sizes& size)
{
    const moving_stage scenery = lit_ramp(double(size.width) / size.height);
    const seen_motion seen = camera_segments(scenery.world, scenery.eye, size.width, size.height, depth_tolerance);
    return row_of(scenery, seen, std::vector<float>(seen.segments.size(), 1.f), size);
}

} // namespace

std::vector<report_row> known_answers(const motion_sizes& size) { return {trapezoid_row(size), lit_ramp_row(size)}; }

} // namespace gnomon::evaluation
