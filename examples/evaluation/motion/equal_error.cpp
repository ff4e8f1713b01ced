// The cost of an accumulation that is as good as analytic receivers: interpolated between the numbers of maps that were
// measured.
#include "evaluation/motion/scene_blocks.hpp"
#include "words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace gnomon::evaluation {

namespace {

// An error that is so many times as large is as good, since all methods share the error that comes from the size of a
// texel, and so is half a step of eight bits.
constexpr double as_good = 1.1, invisible = 0.5 / 255;

struct cost {
    double (*of)(const report_row& row);
    const char *id, *unit, *words;
};
constexpr std::array costs{
    cost{[](const report_row& row) { return row.ns_per_receiver; }, "ns", "ns per receiver", "by look-ups alone"},
    cost{[](const report_row& row) { return row.build_ms + 1e-6 * double(row.receivers) * row.ns_per_receiver; }, "ms",
         "ms for map and receivers", "with the time to build maps"}};

std::vector<const report_row*> accumulations(const scene_results& scene)
{
    std::vector<const report_row*> result;
    for (const scene_row& one : scene.rows)
        if (one.row.family == "accumulation") result.push_back(&one.row);
    return result;
}

// The cost of an accumulation of this error, on a line through the measured ones; none where no number of maps is good
// enough.
std::optional<double> cost_at(const scene_results& scene, const cost& c, double error)
{
    const auto points = accumulations(scene);
    if (points.front()->errors.rmse <= error) return c.of(*points.front());
    for (std::size_t i = 1; i < points.size(); ++i) {
        const double e0 = points[i - 1]->errors.rmse, e1 = points[i]->errors.rmse;
        if (!(e1 <= error)) continue;
        const double passed = e1 > 0 ? std::log(e0 / error) / std::log(e0 / e1) : 1;
        const double t0 = c.of(*points[i - 1]), t1 = c.of(*points[i]);
        return t0 * std::pow(t1 / t0, passed);
    }
    return {};
}

std::optional<double> needed(const scene_results& scene, const cost& c)
{
    return cost_at(scene, c, std::max(as_good * analytic_row(scene).row.errors.rmse, invisible));
}

// Cost of an accumulation that is as good, over that of analytic receivers.
std::optional<double> advantage(const scene_results& scene, const cost& c)
{
    const std::optional<double> other = needed(scene, c);
    if (!other) return {};
    return *other / c.of(analytic_row(scene).row);
}

std::string verdict(const scene_results& scene, const cost& c)
{
    const std::optional<double> found = advantage(scene, c);
    if (!found) return "no accumulation is as good";
    return *found > 1 ? "analytic: " + so_many(*found) + " cheaper"
                      : "accumulation: " + so_many(1 / *found) + " cheaper";
}

std::string listed(const std::vector<std::string>& some)
{
    if (some.empty()) return "no scene";
    std::string result;
    for (const std::string& one : some) result += (result.empty() ? "" : ", ") + one;
    return escaped(result);
}

std::string winners(std::span<const scene_results> scenes, const cost& c)
{
    std::vector<std::pair<double, const scene_results*>> found;
    std::vector<std::string> lost, won, never;
    for (const scene_results& scene : scenes) {
        if (const auto times = advantage(scene, c)) found.emplace_back(*times, &scene);
        else never.push_back(scene.scene.label);
    }
    std::ranges::sort(found, {}, &std::pair<double, const scene_results*>::first);
    for (const auto& [times, scene] : found)
        if (times < 1) lost.push_back(fmt::format("{} ({})", scene->scene.label, so_many(1 / times)));
        else won.insert(won.begin(), fmt::format("{} ({})", scene->scene.label, so_many(times)));
    return fmt::format(
        "At equal error, {}, <b>accumulation is cheaper</b> in: {}. <b>Analytic receivers are cheaper</b> "
        "in: {}. No accumulation is as good as they are in: {}.",
        c.words, listed(lost), listed(won), listed(never));
}

// The values of the parameters in which rows of one method differ.
std::vector<std::string> differences(const std::vector<const report_row*>& rows)
{
    std::vector<std::string> result(rows.size());
    if (rows.size() < 2) return {};
    std::set<std::string> names;
    for (const report_row* row : rows)
        for (const auto& [name, value] : row->parameters)
            for (const report_row* other : rows)
                if (const auto found = other->parameters.find(name);
                    found == other->parameters.end() || found->second != value)
                    names.insert(name);
    for (std::size_t i = 0; i < rows.size(); ++i)
        for (const std::string& name : names)
            if (const auto found = rows[i]->parameters.find(name); found != rows[i]->parameters.end())
                result[i] += fmt::format("{}{:g}", result[i].empty() ? "" : " ", found->second);
    return result;
}

panel panel_of(const scene_results& scene, const cost& c)
{
    panel result{.title = scene.scene.label + "\n" + verdict(scene, c),
                 .x = {.label = c.unit, .scale = scale::log},
                 .y = {.label = "RMSE", .scale = scale::log}};
    std::vector<std::pair<std::string, std::vector<const report_row*>>> groups;
    for (const scene_row& one : scene.rows) {
        if (one.picture.empty()) continue;
        if (one.row.errors.rmse < 1e-5) result.y.scale = scale::symlog, result.y.threshold = 1e-5;
        const std::string key = one.row.method + " " + one.row.receiver;
        if (groups.empty() || groups.back().first != key) groups.emplace_back(key, 0);
        groups.back().second.push_back(&one.row);
    }
    for (const auto& [key, rows] : groups) {
        const report_row& first = *rows.front();
        const receiver_kind& receiver = registry_of<receiver_kind>().at(first.receiver);
        const bool several = rows.size() > 1;
        series shown{
            .label = several ? registry_of<method>().at(first.method).label + ", " + receiver.label : first.label,
            .colour = registry_of<family>().at(first.family).colour,
            .style = several ? style::line : style::points,
            .labelled = false,
            .texts = differences(rows),
            .marker = receiver.marker};
        for (const report_row* row : rows) shown.points.push_back({c.of(*row), row->errors.rmse});
        result.series.push_back(std::move(shown));
    }
    return result;
}

std::string alt_of(std::span<const scene_results> scenes, const cost& c)
{
    std::string result = fmt::format("Error against {}, by method, for each scene.", c.unit);
    for (const scene_results& scene : scenes) result += fmt::format(" {}: {}.", scene.scene.label, verdict(scene, c));
    return result;
}

table_block table_of(std::span<const scene_results> scenes)
{
    table_block table{.columns = {{.key = "scene", .label = "scene"}, error_column("rmse", "RMSE, analytic")},
                      .rows = {}};
    table.columns.back().best = best::none;
    for (const cost& c : costs) {
        const std::string unit = c.unit, id = c.id;
        table.columns.push_back(number_column(id, unit + ", analytic"));
        table.columns.push_back(number_column(id + "_accumulation", unit + ", accumulation"));
        table.columns.push_back(number_column(id + "_ratio", "ratio", 2, best::high));
        table.columns.back().hint = "Times for which accumulation is as expensive, " + std::string(c.words) + ".";
    }
    for (const scene_results& scene : scenes) {
        table_row row{.cells = {{"scene", scene.scene.label}, {"rmse", analytic_row(scene).row.errors.rmse}}};
        for (const cost& c : costs) {
            const std::optional<double> other = needed(scene, c), ratio = advantage(scene, c);
            const auto shown = [](const std::optional<double>& x) { return x ? cell(*x) : cell("∞"); };
            const std::string id = c.id;
            row.cells.emplace_back(id, c.of(analytic_row(scene).row));
            row.cells.emplace_back(id + "_accumulation", shown(other));
            row.cells.emplace_back(id + "_ratio", shown(ratio));
        }
        table.rows.push_back(std::move(row));
    }
    return table;
}

} // namespace

void add_equal_error_blocks(std::span<const scene_results> scenes, std::vector<block>& to)
{
    const auto measured = accumulations(scenes.front());
    const auto maps = [](const report_row* row) { return row->parameters.at("times"); };
    std::string text = fmt::format(
        "The cost of an accumulation that is as good, of up to {} maps: interpolated between those that were measured, "
        "at an "
        "error at most {:.0f}% above that of analytic receivers, since texels limit both, or of {:.2f} thousandths, "
        "half a "
        "step of eight bits. Receivers are projected beforehand for all methods. Accumulation looks its maps up by "
        "packs of "
        "receivers, the others one receiver at a time. A ratio above one is how many times faster analytic receivers "
        "are; "
        "below one, accumulation is. ∞: no accumulation of so many maps is as good. Where the smallest, of {}, is good "
        "enough, its cost stands.",
        maps(measured.back()), 100 * (as_good - 1), 1e3 * invisible, maps(measured.front()));
    for (const cost& c : costs) text += "\n\n" + winners(scenes, c);
    table_block table = table_of(scenes);
    table.title = "Equal error", table.text = std::move(text);
    to.push_back(std::move(table));
    for (const cost& c : costs) {
        chart_block chart{
            .name = std::string("equal_error_") + c.id,
            .alt = alt_of(scenes, c),
            .caption = fmt::format("Error against {} on one core; lower left is better. Lines join rows of "
                                   "one method with the number of maps or the capacity of lists.",
                                   c.unit),
            .panels = {}};
        for (const scene_results& scene : scenes) chart.panels.push_back(panel_of(scene, c));
        to.push_back(std::move(chart));
    }
}

} // namespace gnomon::evaluation
