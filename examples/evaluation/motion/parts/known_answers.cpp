// Scenes whose answer is known without a ray: shadow maps of resolved ranges against their closed forms.
#include "evaluation/core/progress.hpp"
#include "evaluation/core/timing.hpp"
#include "evaluation/motion/motion_method.hpp"
#include "evaluation/motion/motion_part.hpp"
#include "evaluation/motion/motion_scene.hpp"
#include "evaluation/motion/receivers/range_receiver.hpp"

#include <fmt/format.h>
#include <glm/vec3.hpp>

#include <memory>
#include <string>
#include <string_view>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

const registered<reference> closed_form{"closed-form", "the exact answer", 30.0};

constexpr std::uint32_t nobody = 1u << 20; // receivers cast no shadow

report_row row_of_answer(std::string_view scene, const moving_stage& stage, const seen_motion& seen,
                         const std::vector<float>& expected, const motion_sizes& size)
{
    map_source maps(stage.world, stage.light, size.map_resolution);
    const auto& of = registry_of<method>().at("resolved_ranges");
    const range_receiver& receiver = range_receiver_of("analytic");
    const auto map = maps.map(of.id);
    const std::vector<light_receiver> where = light_receivers_of(seen, stage.light, size.map_resolution);
    std::vector<float> found(where.size());
    const double spent = least_seconds([&] { receiver.look_up(*map, where, found); });
    report_row row = row_of(of, *map);
    row.scene = scene;
    row.receiver = receiver.id;
    row.label += ", " + receiver.label;
    row.reference = closed_form->id;
    row.receivers = static_cast<long long>(found.size());
    row.errors = compare(found, expected);
    row.ns_per_receiver = 1e9 * spent / double(found.size());
    return row;
}

const motion_scene& scene_of(std::string_view id)
{
    return dynamic_cast<const motion_scene&>(registry_of<scene_entry>().at(id));
}

// At the points of the ground that project to the centres of texels, for the whole shutter interval.
report_row trapezoid_row(const motion_sizes& size)
{
    const motion_scene& scene = scene_of("trapezoid");
    const moving_stage stage = scene.stage(double(size.width) / size.height);
    const int resolution = size.map_resolution;
    seen_motion seen{resolution, resolution, {0}, {}};
    std::vector<float> expected;
    for (int y = 0; y < resolution; ++y)
        for (int x = 0; x < resolution; ++x) {
            const view_ray ray = ray_through(stage.light.open, (glm::dvec2(x, y) + 0.5) / double(resolution));
            const glm::dvec3 point = ray.origin - ray.origin.y / ray.direction.y * ray.direction;
            const glm::vec3 p(point), up(0, 1, 0);
            seen.segments.push_back({0, 1, 1, nobody, p, p, up, up});
            expected.push_back(static_cast<float>(trapezoid_visibility(point)));
        }
    return row_of_answer(scene.id, stage, seen, expected, size);
}

// At all points that a camera sees.
report_row lit_ramp_row(const motion_sizes& size)
{
    const motion_scene& scene = scene_of("lit_ramp");
    const moving_stage stage = scene.stage(double(size.width) / size.height);
    const seen_motion seen = camera_segments(stage.world, stage.eye, size.width, size.height, depth_tolerance);
    return row_of_answer(scene.id, stage, seen, std::vector<float>(seen.segments.size(), 1.f), size);
}

block table_of(const std::vector<report_row>& rows)
{
    table_block table{.title = "Known answers",
                      .text = "The largest error of visibility, where the exact visibility is known.",
                      .columns = {{.key = "scene", .label = "scene"},
                                  {.key = "method", .label = "method"},
                                  {.key = "receivers", .label = "receivers", .digits = 0},
                                  {.key = "largest", .label = "largest error"}},
                      .rows = {}};
    for (const report_row& row : rows)
        table.rows.push_back({.cells = {{"scene", scene_of(row.scene).label},
                                        {"method", row.label},
                                        {"receivers", double(row.receivers)},
                                        {"largest", fmt::format("{:.1e}", row.errors.max_abs)}}});
    return table;
}

part_run known_answers(const motion_settings& how)
{
    const auto found = std::make_shared<std::vector<report_row>>();
    return {.tasks = {[=, size = how.size] {
                *found = {trapezoid_row(size), lit_ramp_row(size)};
            }},
            .results = [=] { return part_results{.rows = *found, .blocks = {table_of(*found)}}; }};
}

const registered<motion_part> entry{
    motion_part{.id = "known_answers", .label = "known answers", .order = 50, .begin = known_answers}};

} // namespace

} // namespace gnomon::evaluation
