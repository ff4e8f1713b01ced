#include "scattering_costs.hpp"

#include "evaluation/core/timed_look_ups.hpp"
#include "scattering_comparison.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <utility>

namespace gnomon::evaluation {

namespace {

constexpr std::array widths{480, 960, 1920, 2880, 3840};
constexpr int usual_width = 1920;
constexpr const char* baseline = "ray_march_128_unorm16"; // what the paper compares with

// The settings of the paper without filtering, the library's six moments, and the rivals of each kind.
constexpr std::array shown{
    "ray_march_32_unorm16",   baseline,          "min_max", "froxels", "scatter_csm", "scatter4_unorm16_paper",
    "scatter6_unorm16_paper", "scatter6_unorm16"};

double pixels_of(int width) { return double(width) * (width * 9 / 16); }

settings sizes(int width, int resolution)
{
    return {.width = width, .height = width * 9 / 16, .map_resolution = resolution};
}

// View rays of a picture of this width: runs of neighbours from all over it, in the directions of its pixels, as long as those
// of the nearest pixels of a smaller picture.
std::vector<view_segment> rays_of_picture(const scattering_view& view, int width)
{
    constexpr std::size_t runs = 16, neighbours = 256;
    const std::array<glm::vec3, 4> corners = view.scene().corners;
    const int height = width * 9 / 16;
    const float scale = float(view.seen.width) / float(width);
    std::vector<view_segment> result;
    for (std::size_t run = 0; run < runs; ++run)
        for (std::size_t i = 0; i < neighbours; ++i) {
            const std::size_t first =
                (2 * run + 1) * (std::size_t(width) * std::size_t(height) - neighbours) / (2 * runs);
            const auto x = int((first + i) % std::size_t(width)), y = int((first + i) / std::size_t(width));
            const glm::vec2 pixel(float(x) + 0.5f, float(y) + 0.5f);
            const auto column = std::min(int(pixel.x * scale), view.seen.width - 1),
                       row = std::min(int(pixel.y * scale), view.seen.height - 1);
            const view_segment& close =
                view.where[std::size_t(row) * std::size_t(view.seen.width) + std::size_t(column)];
            const glm::vec3 direction = corners[0] + pixel.x / float(width) * (corners[1] - corners[0]) +
                                        pixel.y / float(height) * (corners[3] - corners[0]);
            result.push_back({glm::length(close.end) * glm::normalize(direction), close.footprint * scale, pixel});
        }
    return result;
}

// Nanoseconds per view ray, one by one or by packs, whichever is faster.
double fastest(const scattering_map& map, std::span<const view_segment> where)
{
    std::vector<float> scratch(where.size());
    double least = std::numeric_limits<double>::infinity();
    for (const timed_look_up& way : map.timed(where)) least = std::min(least, nanoseconds(way.look_up, scratch, 0.008));
    return least;
}

double milliseconds(const std::vector<build_pass>& passes)
{
    double sum = 0;
    for (const build_pass& p : passes) sum += p.milliseconds;
    return sum;
}

// Of maps, in texels along each side: the finest one, and halves of it.
struct map_sizes {
    int finest;

    int usual() const { return finest / 2; }
    std::array<int, 4> all() const { return {finest / 8, finest / 4, finest / 2, finest}; }
};

struct measured_method {
    const scattering_method* of;
    std::map<int, double> ns_of_width;             // with maps of the usual resolution
    std::map<int, double> ns_of_resolution;        // in a picture of the usual width
    std::map<int, std::vector<build_pass>> passes; // by resolution

    double frame(int width, int resolution) const
    {
        return milliseconds(passes.at(resolution)) + 1e-6 * ns_of_width.at(width) * pixels_of(width);
    }
};

std::vector<measured_method> measured(const renderer::scattering_stage& stage, map_sizes maps)
{
    std::vector<measured_method> result;
    for (const char* id : shown)
        result.push_back({&dynamic_cast<const scattering_method&>(registry_of<method>().at(id)), {}, {}, {}});
    for (const int resolution : maps.all()) {
        const scattering_view view(stage, sizes(widths[0], resolution));
        for (measured_method& m : result) {
            const std::unique_ptr<scattering_map> map = m.of->build(view.scene());
            m.passes[resolution] = map->passes();
            m.ns_of_resolution[resolution] = fastest(*map, rays_of_picture(view, usual_width));
            if (resolution != maps.usual()) continue;
            for (const int width : widths) m.ns_of_width[width] = fastest(*map, rays_of_picture(view, width));
        }
    }
    return result;
}

series line_of(const measured_method& m, const panel& in)
{
    series s{.label = m.of->label, .colour = m.of->its_family().colour, .style = style::line};
    const auto alike = std::ranges::count_if(in.series, [&](const series& other) { return other.colour == s.colour; });
    s.dashed = alike == 1;
    s.marker = alike < 2 ? "circle" : "square";
    return s;
}

chart_block against_picture(const std::vector<measured_method>& methods, map_sizes maps)
{
    panel frame{.title = "a frame: build and look-ups",
                .x = {.label = "pixels of the picture", .scale = scale::log},
                .y = {.label = "ms on one core", .scale = scale::log},
                .series = {}};
    for (const int width : widths)
        frame.x.ticks.emplace_back(pixels_of(width), fmt::format("{} x {}", width, width * 9 / 16));
    panel ray = frame;
    ray.title = "a view ray: look-up";
    ray.y.label = "ns";
    for (const measured_method& m : methods) {
        series of_frame = line_of(m, frame), of_ray = line_of(m, ray);
        for (const int width : widths) {
            of_frame.points.push_back({pixels_of(width), m.frame(width, maps.usual())});
            of_ray.points.push_back({pixels_of(width), m.ns_of_width.at(width)});
        }
        frame.series.push_back(std::move(of_frame));
        ray.series.push_back(std::move(of_ray));
    }
    return {.title = "Cost against the size of the picture",
            .text = {},
            .name = "cost-per-picture",
            .alt =
                "Time per frame and per view ray against the number of pixels, for ray marching, min-max mipmaps, "
                "froxels, convolution maps and moments.",
            .caption = fmt::format(
                "Maps of {0} x {0} texels. Look-ups are timed on 4096 pixels in runs of neighbours from "
                "all over a picture of each size, and multiplied by its pixels. View rays one after the other "
                "or by packs, whichever is faster.",
                maps.usual()),
            .panels = {std::move(frame), std::move(ray)}};
}

chart_block against_map(const std::vector<measured_method>& methods, map_sizes maps)
{
    axis x{.label = "texels along each side of the maps", .scale = scale::log};
    for (const int r : maps.all()) x.ticks.emplace_back(double(r), fmt::format("{}", r));
    panel ray{.title = "a view ray: look-up", .x = x, .y = {.label = "ns", .scale = scale::log}, .series = {}};
    std::vector<std::pair<std::string, std::string>> names{
        {"rectify", "build: rectify"}, {"prefix", "build: prefix averages"}, {"mips", "build: mip levels"}};
    std::vector<panel> panels;
    for (const measured_method& m : methods) {
        series s = line_of(m, ray);
        for (const int r : maps.all()) s.points.push_back({double(r), m.ns_of_resolution.at(r)});
        ray.series.push_back(std::move(s));
    }
    for (const auto& [id, title] : names) {
        panel p{.title = title, .x = x, .y = {.label = "ns per texel on one core", .scale = scale::log}, .series = {}};
        for (const measured_method& m : methods) {
            series s = line_of(m, p);
            for (const int r : maps.all())
                for (const build_pass& pass : m.passes.at(r))
                    if (pass.name == id) s.points.push_back({double(r), 1e6 * pass.milliseconds / (double(r) * r)});
            if (!s.points.empty()) p.series.push_back(std::move(s));
        }
        panels.push_back(std::move(p));
    }
    panels.push_back(std::move(ray));
    return {.title = "Cost against the size of the maps",
            .text = {},
            .name = "cost-per-map",
            .alt = "Time of each pass per texel, and of look-ups, against the size of the shadow map.",
            .caption = fmt::format(
                "Rectified maps have as many texels as the shadow map. Look-ups as in a picture of {} x {}.",
                usual_width, usual_width * 9 / 16),
            .panels = std::move(panels)};
}

// Of the rows of one scene and method, the fastest; against ray tracing, over the whole picture.
std::map<std::string, std::map<std::string, report_row>> fastest_rows(std::span<const report_row> rows)
{
    std::map<std::string, std::map<std::string, report_row>> result; // by method and scene
    for (const report_row& r : rows) {
        if (r.reference != scattering_references[1].id || !r.part.empty()) continue;
        const auto [at, is_new] = result[r.method].try_emplace(r.scene, r);
        if (!is_new && r.ns_per_receiver < at->second.ns_per_receiver) at->second = r;
    }
    return result;
}

chart_block against_error(std::span<const report_row> rows)
{
    panel p{.title = {},
            .x = {.label = fmt::format("ns per pixel of {} x {}, with the build", usual_width, usual_width * 9 / 16),
                  .scale = scale::log},
            .y = {.label = "RMSE against ray tracing, over all scenes", .scale = scale::log},
            .pareto = true,
            .series = {}};
    p.size = "bytes of the map";
    std::size_t scenes = 0;
    for (const auto& [id, of_scenes] : fastest_rows(rows)) scenes = std::max(scenes, of_scenes.size());
    for (const auto& [id, of_scenes] : fastest_rows(rows)) {
        if (of_scenes.size() < scenes) continue; // of some scenes only
        double cost = 0, squares = 0, bytes = 0;
        for (const auto& [scene, r] : of_scenes) {
            cost += r.ns_per_receiver + 1e6 * r.build_ms / pixels_of(usual_width);
            squares += r.errors.rmse * r.errors.rmse;
            bytes = std::max(bytes, r.map_bytes);
        }
        const auto& m = registry_of<method>().at(id);
        p.series.push_back({.label = m.label,
                            .colour = m.its_family().colour,
                            .points = {{cost / double(scenes), std::sqrt(squares / double(scenes)), bytes}}});
    }
    return {.title = "Error against cost",
            .text = {},
            .name = "error-per-cost",
            .alt = fmt::format("Error over {} scenes against time per pixel, with the build of the map, of {} methods.",
                               scenes, p.series.size()),
            .caption =
                "Lower left is better. The build is divided by the pixels of the picture. Noise of ray marching and of "
                "froxels counts as error, though a blur or earlier frames may hide it.",
            .panels = {std::move(p)}};
}

table_block ratios(const std::vector<measured_method>& methods, std::span<const report_row> rows, map_sizes maps)
{
    table_block result{
        .title = "How much cheaper than ray marching with 128 steps",
        .text = fmt::format(
            "Of a picture of {} x {} with maps of {} x {} texels: the time of 128 steps through a map of 16 "
            "bits over that of the method. From scene to scene: the slowest look-up over the fastest. "
            "Prefiltered maps read two mip levels where a pixel covers more than one row, else one.",
            usual_width, usual_width * 9 / 16, maps.usual(), maps.usual()),
        .columns = {{.key = "method", .label = "method"},
                    {.key = "look_up", .label = "look-up", .digits = 2, .best = best::high},
                    {.key = "frame", .label = "with the build", .digits = 2, .best = best::high},
                    {.key = "ns", .label = "ns", .digits = 1, .best = best::low, .hint = "per view ray"},
                    {.key = "build", .label = "build, ms", .digits = 1, .best = best::low, .hint = "on one core"},
                    {.key = "scenes", .label = "from scene to scene", .digits = 2, .best = best::low}},
        .rows = {}};
    const auto of =
        std::ranges::find(methods, std::string(baseline), [](const measured_method& m) { return m.of->id; });
    const auto by_scene = fastest_rows(rows);
    for (const measured_method& m : methods) {
        cell between_scenes;
        if (const auto found = by_scene.find(m.of->id); found != by_scene.end()) {
            double least = std::numeric_limits<double>::infinity(), most = 0;
            for (const auto& [scene, r] : found->second)
                least = std::min(least, r.ns_per_receiver), most = std::max(most, r.ns_per_receiver);
            between_scenes = most / least;
        }
        const double ns = m.ns_of_width.at(usual_width);
        result.rows.push_back({{{"method", m.of->label},
                                {"look_up", of->ns_of_width.at(usual_width) / ns},
                                {"frame", of->frame(usual_width, maps.usual()) / m.frame(usual_width, maps.usual())},
                                {"ns", ns},
                                {"build", milliseconds(m.passes.at(maps.usual()))},
                                {"scenes", between_scenes}},
                               m.of->its_family().colour});
    }
    return result;
}

} // namespace

std::vector<block> scattering_costs(const renderer::scattering_stage& stage, std::span<const report_row> rows,
                                    int finest_resolution)
{
    const map_sizes maps{finest_resolution};
    const std::vector<measured_method> methods = measured(stage, maps);
    return {against_error(rows), against_picture(methods, maps), against_map(methods, maps),
            ratios(methods, rows, maps)};
}

} // namespace gnomon::evaluation
