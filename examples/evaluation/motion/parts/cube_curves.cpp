// The curves of Hong & Oh 2017: memory and time of shadow maps of ranges, against the number of random cubes at one
// speed, and against their speed at one number, for small cubes and for large ones.
#include "evaluation/core/progress.hpp"
#include "evaluation/motion/cube_costs.hpp"
#include "evaluation/motion/motion_part.hpp"
#include "evaluation/motion/words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <span>

namespace gnomon::evaluation {

namespace {

constexpr float small = 0.125f, large = 0.5f; // half-extents
constexpr int number = 400;                   // of cubes where their speed changes
constexpr std::array samples{8, 20, 64};      // of a time-dependent shadow map

constexpr std::array cases{cube_case{100, 1},
                           cube_case{200, 1},
                           cube_case{number, 1},
                           cube_case{800, 1},
                           cube_case{1600, 1},
                           cube_case{number, 2},
                           cube_case{number, 4},
                           cube_case{number, 8},
                           cube_case{number, 1.f / 32, large},
                           cube_case{number, 1.f / 8, large},
                           cube_case{number, 1.f / 2, large},
                           cube_case{number, 2, large},
                           cube_case{number, 8, large}};

struct quantity {
    double (*of)(const map_costs& m);
    const char *id, *unit, *words;
};
constexpr std::array quantities{
    quantity{[](const map_costs& m) { return 0x1p-20 * double(m.facts.bytes); }, "bytes", "MiB", "memory of the map"},
    quantity{[](const map_costs& m) { return m.facts.build_ms; }, "build", "ms, one core", "time to build the map"},
    quantity{[](const map_costs& m) { return m.ns_per_pair; }, "pairs", "ns per texel and triangle",
             "time for each texel that a triangle covers at some time"}};

struct view {
    std::string title, label;
    bool (*shows)(const cube_case& c);
    double (*place)(const cube_case& c);
};
const std::array views{view{fmt::format("cubes of half-extent {:g}, speed 1", small), "cubes",
                            [](const cube_case& c) { return c.half_extent == small && c.speed == 1; },
                            [](const cube_case& c) { return double(c.count); }},
                       view{fmt::format("{} cubes of half-extent {:g}", number, small), "speed",
                            [](const cube_case& c) { return c.half_extent == small && c.count == number; },
                            [](const cube_case& c) { return double(c.speed); }},
                       view{fmt::format("{} cubes of half-extent {:g}", number, large), "speed",
                            [](const cube_case& c) { return c.half_extent == large && c.count == number; },
                            [](const cube_case& c) { return double(c.speed); }}};

using all_costs = std::vector<cube_costs>;

panel panel_of(const view& v, const quantity& q, const all_costs& found, int resolution)
{
    panel result{
        .title = v.title, .x = {.label = v.label, .scale = scale::log}, .y = {.label = q.unit, .scale = scale::log}};
    std::vector<const cube_costs*> shown;
    for (const cube_costs& c : found)
        if (v.shows(c.at)) shown.push_back(&c);
    std::ranges::sort(shown, {}, [&](const cube_costs* c) { return v.place(c->at); });
    for (const cube_costs* c : shown) result.x.ticks.emplace_back(v.place(c->at), ratio(v.place(c->at)));
    for (std::size_t m = 0; m < shown.front()->maps.size(); ++m) {
        const motion_method& of = *shown.front()->maps[m].method;
        series line{.label = of.label,
                    .colour = of.its_family().colour,
                    .style = style::line,
                    .labelled = false,
                    .marker = "circle"};
        series building{.label = of.label + ", with the fragments that building needs",
                        .colour = line.colour,
                        .style = style::line,
                        .labelled = false,
                        .dashed = true,
                        .marker = "none"};
        for (const cube_costs* c : shown) {
            line.points.push_back({v.place(c->at), q.of(c->maps[m])});
            building.points.push_back({v.place(c->at), 0x1p-20 * double(c->maps[m].facts.building_bytes)});
        }
        result.series.push_back(std::move(line));
        if (std::string_view(q.id) == "bytes" && building.points.front()[1] > 0)
            result.series.push_back(std::move(building));
    }
    if (std::string_view(q.id) == "bytes") {
        series levels{.label = fmt::format("time-dependent shadow maps of {} samples", fmt::join(samples, ", ")),
                      .colour = "#555555",
                      .style = style::rule,
                      .labelled = false,
                      .dashed = true};
        for (const int count : samples)
            levels.points.push_back(
                {std::numeric_limits<double>::quiet_NaN(), 0x1p-18 * count * double(resolution) * double(resolution)});
        result.series.push_back(std::move(levels));
    }
    return result;
}

// Memory of prisms without coverage over that with it, by their formula (2).
double saved(const cube_costs& c)
{
    const auto of = [&](std::string_view id) {
        return double(std::ranges::find(c.maps, id, [](const map_costs& m) {
                          return std::string_view(m.method->id);
                      })->facts.building_bytes);
    };
    return of("prism_ranges") / of("covered_prism_ranges");
}

std::string described(const cube_costs& c)
{
    return fmt::format("{:.1f} times as much ({} cubes of half-extent {:g}, speed {})", saved(c), c.at.count,
                       c.at.half_extent, ratio(double(c.at.speed)));
}

std::string text_of(const all_costs& found, int resolution)
{
    const auto [least, most] = std::ranges::minmax_element(found, {}, saved);
    return fmt::format(
        "The curves of Hong &amp; Oh: random cubes, seen by shadow maps of {} x {} texels: more and more of them, "
        "faster and "
        "faster ones, and faster and faster ones that are larger. The longest path of a cube is {:g} times the speed. "
        "Memory "
        "is that of the map that look-ups read. While they are built, prisms need memory for the fragments that they "
        "pair, "
        "too: that sum, their formula (2), is dashed. Level lines are time-dependent shadow maps of {} samples, 4 "
        "bytes each. "
        "Coverage leaves out what is hidden where one triangle covers a texel while the shutter is open. Without "
        "coverage, "
        "prisms need, by their formula, from {} to {}. Resolved lists have what is in front at each time. Those of "
        "casters "
        "leave out the backdrop as well, what is behind all else in a texel while the shutter is open, as the ground "
        "often "
        "is: the backdrop shadows nothing. Packed lists are the same in fewer bits, which look-ups read as they are. "
        "Time "
        "includes all that a look-up needs, so that of resolved lists is that of building and resolving.",
        resolution, resolution, longest_path, fmt::join(samples, ", "), described(*least), described(*most));
}

std::string alt_of(const quantity& q, const all_costs& found)
{
    std::string result =
        fmt::format("The {} in {}, for each kind of map, against the number and the speed of cubes.", q.words, q.unit);
    const auto most = std::ranges::max_element(found, {}, [](const cube_costs& c) { return c.pairs; });
    result += fmt::format(" At {} cubes of half-extent {:g} and speed {}:", most->at.count, most->at.half_extent,
                          ratio(double(most->at.speed)));
    for (const map_costs& m : most->maps)
        result += fmt::format("{} {} {:.3g}", &m == most->maps.data() ? "" : ",", m.method->label, q.of(m));
    return result + ".";
}

part_results results(const all_costs& found, int resolution)
{
    part_results r;
    r.blocks.push_back(text_block{"Memory and time", text_of(found, resolution)});
    for (const quantity& q : quantities) {
        chart_block chart{.name = std::string("cubes_") + q.id,
                          .alt = alt_of(q, found),
                          .caption = fmt::format("The {}.", q.words),
                          .panels = {}};
        for (const view& v : views) chart.panels.push_back(panel_of(v, q, found, resolution));
        r.blocks.push_back(std::move(chart));
    }
    return r;
}

part_run cube_curves(const motion_settings& how)
{
    const auto found = std::make_shared<all_costs>(cases.size());
    part_run result;
    for (std::size_t i = 0; i < cases.size(); ++i)
        result.tasks.push_back(
            [=, resolution = how.size.map_resolution] { (*found)[i] = costs_of(cases[i], resolution); });
    result.results = [=, resolution = how.size.map_resolution] { return results(*found, resolution); };
    return result;
}

const registered<motion_part> entry{
    motion_part{.id = "cube_curves", .label = "memory and time", .order = 30, .begin = cube_curves}};

} // namespace

} // namespace gnomon::evaluation
