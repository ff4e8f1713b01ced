#include "evaluation/motion/words.hpp"
#include "layered_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace gnomon::evaluation {

namespace {

constexpr double thousandths = 1e3;

struct step {
    const char* label;
    const char* colour;
    double (*ms)(const compared_layers&, const layered_result&);
};

// The steps of Andersson et al. 2015, Figure 15.
constexpr std::array steps_of_frame{
    step{"visibility sampling", "#1f77b4",
         [](const compared_layers&, const layered_result& r) { return r.sampling_ms; }},
    step{"conversion", "#ff7f0e", [](const compared_layers&, const layered_result& r) { return r.conversion_ms; }},
    step{"camera rasterization", "#2ca02c",
         [](const compared_layers& s, const layered_result&) { return s.camera_ms; }},
    step{"look-up and shading", "#d62728",
         [](const compared_layers& s, const layered_result& r) { return r.look_up_ms + s.shading_ms; }}};

// A bar from low to high at place x of a band, whose other points have no height.
void add_bar(series& to, double x, double low, double high)
{
    constexpr double half = 0.38, edge = 1e-4;
    to.points.push_back({x - half - edge, 0, 0});
    to.points.push_back({x - half, low, high});
    to.points.push_back({x + half, low, high});
    to.points.push_back({x + half + edge, 0, 0});
}

// The usual result of each family with equal input that has one, at no constant bias.
std::vector<const layered_result*> usual_of_families(const compared_layers& scene)
{
    std::vector<const layered_result*> result;
    for (const family* f : registry_of<family>().all()) {
        const layered_result* found = nullptr;
        for (const layered_result& r : scene.results)
            if (r.method->family == f->id && r.is_of(equal_input) && r.constant_bias == 0 &&
                (!found || r.method->id == usual_layers))
                found = &r;
        if (found) result.push_back(found);
    }
    return result;
}

} // namespace

chart_block bias_chart(compared_scenes scenes)
{
    chart_block chart{.title = "Acne against leak by the constant bias",
                      .text =
                          "Each line goes through the same constants of signed depth, beyond the bias by slope: from "
                          "none to 0.32, which parts shadows from their casters.",
                      .name = "bias",
                      .alt = {},
                      .caption = {},
                      .panels = {},
                      .is_folded = true};
    for (const compared_layers& scene : scenes) {
        panel p{.title = scene.scene.label,
                .x = {.label = "leak, thousandths", .scale = scale::symlog, .threshold = 1},
                .y = {.label = "acne, thousandths", .scale = scale::symlog, .threshold = 1},
                .series = {}};
        for (const bias_curve& curve : scene.curves) {
            if (curve.variant != &curve.method->variants.front()) continue;
            series s{.label = curve.method->label,
                     .colour = curve.method->its_family().colour,
                     .style = style::line,
                     .labelled = false};
            for (const bias_point& point : curve.points)
                s.points.push_back({thousandths * point.leak, thousandths * point.acne});
            p.series.push_back(std::move(s));
        }
        if (!p.series.empty()) chart.panels.push_back(std::move(p));
    }
    chart.alt = fmt::format("Lines of acne against leak in {} scenes, one for each method.", chart.panels.size());
    chart.caption = "One seed.";
    return chart;
}

chart_block steps_chart(compared_scenes scenes)
{
    chart_block chart{.title = "Time by step",
                      .text =
                          "As in Figure 15 of Andersson et al., on one core of a CPU. The map of ranges has its "
                          "rasterization as visibility sampling.",
                      .name = "steps",
                      .alt = {},
                      .caption = {},
                      .panels = {}};
    std::vector<const layered_method*> methods; // of any scene, by their numbers below
    for (const compared_layers& scene : scenes)
        for (const layered_result* r : usual_of_families(scene))
            if (std::ranges::count(methods, r->method) == 0) methods.push_back(r->method);
    for (std::size_t i = 0; i < methods.size(); ++i)
        chart.caption += fmt::format("{}{} {}", i > 0 ? "; " : "", i + 1, escaped(methods[i]->label));
    for (const compared_layers& scene : scenes) {
        const std::vector<const layered_result*> shown = usual_of_families(scene);
        panel p{.title = scene.scene.label,
                .x = {.label = "method, see below", .least = 0.5, .most = double(methods.size()) + 0.5},
                .y = {.label = "ms of one core", .least = 0},
                .series = {}};
        std::vector<double> reached(shown.size());
        for (const step& part : steps_of_frame) {
            series s{.label = part.label, .colour = part.colour, .style = style::band, .labelled = false};
            for (std::size_t i = 0; i < shown.size(); ++i) {
                const double low = reached[i];
                reached[i] += part.ms(scene, *shown[i]);
                const auto at = std::ranges::find(methods, shown[i]->method) - methods.begin();
                add_bar(s, double(at + 1), low, reached[i]);
            }
            p.series.push_back(std::move(s));
        }
        for (std::size_t i = 0; i < methods.size(); ++i) p.x.ticks.emplace_back(double(i + 1), std::to_string(i + 1));
        chart.panels.push_back(std::move(p));
    }
    chart.alt = fmt::format("Bars of four steps for each method in {} scenes.", chart.panels.size());
    return chart;
}

chart_block rivals_chart(compared_scenes scenes)
{
    chart_block chart{.title = "Layers and ranges",
                      .text =
                          "Each point is a scene. Ranges grow with what moves, and with how far it moves; layers "
                          "cost the same for each sample of map and camera.",
                      .name = "rivals",
                      .alt = {},
                      .caption = {},
                      .panels = {}};
    struct measure {
        const char* label;
        double (*of)(const layered_result&);
    };
    constexpr std::array measures{
        measure{"ms of map and look-ups", [](const layered_result& r) { return r.total_ms(); }},
        measure{"MiB of the map", [](const layered_result& r) { return r.row.map_bytes / 1048576; }}};
    for (const measure& m : measures) {
        panel p{.title = m.label,
                .x = {.label = m.label, .scale = scale::log},
                .y = {.label = "RMSE, thousandths", .scale = scale::log},
                .series = {}};
        for (const family* f : {&*slices_family, &*layers_family, &*footprints_family}) {
            series s{.label = f->label, .colour = f->colour, .labelled = false};
            for (const compared_layers& scene : scenes)
                for (const layered_result* r : usual_of_families(scene))
                    if (r->method->family == f->id && r->row.errors.rmse > 0)
                        s.points.push_back({m.of(*r), thousandths * r->row.errors.rmse});
            if (!s.points.empty()) p.series.push_back(std::move(s));
        }
        chart.panels.push_back(std::move(p));
    }
    std::string faster, slower;
    for (const compared_layers& scene : scenes) {
        const layered_result* layers = scene.usual(usual_layers);
        const layered_result* ranges = best_of(scene, *footprints_family, equal_input);
        if (!layers || !ranges) continue;
        std::string& to = layers->total_ms() < ranges->total_ms() ? faster : slower;
        to += fmt::format("{}{} ({} against {} ms, {:.1f} against {:.1f} MiB)", to.empty() ? "" : ", ",
                          scene.scene.label, grouped(layers->total_ms()), grouped(ranges->total_ms()),
                          layers->row.map_bytes / 1048576, ranges->row.map_bytes / 1048576);
    }
    if (!faster.empty() || !slower.empty())
        chart.text +=
            fmt::format("\n\n<b>Layers are faster</b> than ranges over footprints {}; <b>slower</b> {}.",
                        faster.empty() ? "nowhere" : "in: " + faster, slower.empty() ? "nowhere" : "in: " + slower);
    chart.alt = "Errors of scenes against time and against memory, of three families of methods.";
    chart.caption = "Lower left is better.";
    return chart;
}

} // namespace gnomon::evaluation
