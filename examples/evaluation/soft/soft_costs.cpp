#include "soft_costs.hpp"

#include "evaluation/core/timed_look_ups.hpp"
#include "soft_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <utility>

namespace gnomon::evaluation {

namespace {

constexpr std::array searches{9, 15, 27, 39, 51, 63};

// The map again and again, until a map of this resolution is full.
template <class T> renderer::image<T> tiled(const renderer::image<T>& tile, int resolution)
{
    renderer::image<T> result(resolution, resolution);
    for (int y = 0; y < resolution; ++y)
        for (int x = 0; x < resolution; ++x) result(x, y) = tile(x % tile.width, y % tile.height);
    return result;
}

// One method for each kind of table.
std::vector<const soft_method*> methods_with_tables()
{
    std::vector<const soft_method*> result;
    for (const soft_method* m : soft_methods())
        if (m->map == "summed_area" &&
            std::ranges::none_of(result, [&](const soft_method* other) { return other->format.id == m->format.id; }))
            result.push_back(m);
    return result;
}

axis resolutions_axis(const std::vector<int>& resolutions)
{
    axis result{.label = "texels along each side of the map", .scale = scale::log};
    for (const int r : resolutions) result.ticks.emplace_back(double(r), fmt::format("{}", r));
    return result;
}

} // namespace

chart_block cost_of_texels(const soft_stage& stage, int finest_resolution)
{
    std::vector<int> resolutions;
    for (int r = finest_resolution / 16; r <= finest_resolution; r *= 2) resolutions.push_back(r);
    panel time{.title = "time of the build",
               .x = resolutions_axis(resolutions),
               .y = {.label = "ms on one core", .scale = scale::log},
               .series = {}};
    panel memory{.title = "memory",
                 .x = resolutions_axis(resolutions),
                 .y = {.label = "MiB", .scale = scale::log},
                 .series = {}};
    const std::vector<const soft_method*> methods = methods_with_tables();
    for (const soft_method* m : methods)
        for (panel* p : {&time, &memory})
            p->series.push_back({.label = m->format.label, .colour = m->its_family().colour, .style = style::line});
    const double copied = registry_of<method>().at("msm4_soft").format.bytes_per_texel;
    time.series.push_back({.label = fmt::format("copy of {:g} bytes per texel", copied),
                           .colour = "#888888",
                           .style = style::line,
                           .dashed = true,
                           .marker = "none"});
    for (const int resolution : resolutions) {
        const depth_map samples = tiled(stage.samples, resolution);
        const renderer::image<std::array<float, 1>> none;
        soft_light light = stage.light(usual_search);
        light.map_width = light.map_height = float(resolution);
        for (std::size_t i = 0; i < methods.size(); ++i) {
            std::unique_ptr<soft_shadow_map> map;
            const double build = least_seconds([&] { map = methods[i]->build({samples, none}, light); });
            time.series[i].points.push_back({double(resolution), 1e3 * build});
            memory.series[i].points.push_back({double(resolution), double(map->bytes()) / 0x1p20});
        }
        const auto bytes = std::size_t(copied * resolution * resolution);
        const std::vector<char> from(bytes, 1);
        std::vector<char> to(bytes, 2);
        const double copy = least_seconds([&] {
            std::memcpy(to.data(), from.data(), bytes);
            asm volatile("" : : "r"(to.data()) : "memory");
        });
        time.series.back().points.push_back({double(resolution), 1e3 * copy});
    }
    return {
        .title = "Cost per texel",
        .text = "The table is built from four depth samples per texel: resolve, transform and both sums in one pass.",
        .name = "cost-per-texel",
        .alt = "Time and memory of summed-area tables against the resolution of the map, for each kind of table.",
        .caption = "Maps of each resolution hold the same depths over and over.",
        .panels = {std::move(time), std::move(memory)}};
}

chart_block cost_of_receivers(const soft_stage& stage, const std::vector<std::string>& ids)
{
    const std::vector<soft_receiver> where = runs_to_time(stage.where, 256);
    const soft_widths<float> widest = stage.light(1e6f).penumbra(1.f, -1.f);
    panel p{.title = {},
            .x = {.label = "widest search, texels along each axis"},
            .y = {.label = "ns per receiver, with the look-ups", .scale = scale::log},
            .series = {}};
    for (const int search : searches) p.x.ticks.emplace_back(double(search), fmt::format("{}", search));
    std::vector<float> scratch(where.size());
    for (const std::string& id : ids) {
        const auto& m = dynamic_cast<const soft_method&>(registry_of<method>().at(id));
        series s{.label = m.map == "depths" ? "PCSS" : m.label, .colour = m.its_family().colour, .style = style::line};
        s.dashed = std::ranges::any_of(p.series, [&](const series& other) { return other.colour == s.colour; });
        for (const int search : searches) {
            soft_light light = stage.light(float(search));
            const float growth = float(search) / std::max(widest.x, widest.y);
            light.texels = {light.texels.x * growth, light.texels.y * growth};
            const std::unique_ptr<soft_shadow_map> map = m.build(stage.depths(), light);
            double least = std::numeric_limits<double>::infinity();
            for (const timed_look_up& way : map->timed(where))
                least = std::min(least, nanoseconds(way.look_up, scratch, 0.02));
            s.points.push_back({double(search), least});
        }
        p.series.push_back(std::move(s));
    }
    return {.title = "Cost per receiver",
            .text = {},
            .name = "cost-per-receiver",
            .alt =
                "Time per receiver against the width of the search region, for methods with tables and for "
                "percentage-closer "
                "soft shadows.",
            .caption =
                "The light grows with the search, so that the widest penumbra is as wide as the widest search. "
                "Receivers one after the other or by packs, whichever is faster, on one core.",
            .panels = {std::move(p)}};
}

} // namespace gnomon::evaluation
