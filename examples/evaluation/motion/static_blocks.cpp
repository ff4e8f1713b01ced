#include "static_blocks.hpp"

#include "words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace gnomon::evaluation {

namespace {

std::string words_of_part(const std::string& part) { return part == among_casters ? "among casters" : "behind all"; }

// Speed and part, in the order of the table.
struct place {
    double speed;
    std::string part;

    friend bool operator==(const place&, const place&) = default;
    friend bool operator<(const place& a, const place& b)
    {
        return std::tuple(a.speed, a.part == among_casters) < std::tuple(b.speed, b.part == among_casters);
    }
};

place place_of(const report_row& row) { return {row.parameters.at("speed"), row.part}; }

std::string winners(std::span<const report_row> rows)
{
    std::set<place> places;
    for (const report_row& row : rows) places.insert(place_of(row));
    std::string cheaper, dearer;
    for (const place& at : places) {
        const report_row *ranges = nullptr, *maps = nullptr;
        for (const report_row& row : rows) {
            if (!(place_of(row) == at) || has_tent(row) || row.family == "rays") continue;
            const report_row*& best = row.family == "accumulation" ? maps : ranges;
            if (!best || row.ns_per_receiver < best->ns_per_receiver) best = &row;
        }
        if (!ranges || !maps) continue;
        std::string& to = maps->ns_per_receiver < ranges->ns_per_receiver ? cheaper : dearer;
        to += fmt::format("{}{} at {:g} x (ranges {} ns, RMSE {:.2f}; {} {} ns, {:.2f})", to.empty() ? "" : ", ",
                          words_of_part(at.part), at.speed, grouped(ranges->ns_per_receiver), 1e3 * ranges->errors.rmse,
                          maps->label, grouped(maps->ns_per_receiver), 1e3 * maps->errors.rmse);
    }
    return fmt::format(
        "<b>Accumulation is faster</b> than the fastest ranges for receivers {}; <b>ranges are faster</b> {}.",
        cheaper.empty() ? "nowhere" : cheaper, dearer.empty() ? "nowhere" : dearer);
}

double ns_of_rays(std::span<const report_row> rows, const place& at)
{
    for (const report_row& row : rows)
        if (row.method == "rays" && place_of(row) == at && !has_tent(row) && row.parameters.at("times") == least_rays)
            return row.ns_per_receiver;
    return 0;
}

} // namespace

bool has_tent(const report_row& row) { return row.parameters.contains("tent"); }

block static_table(std::span<const report_row> rows)
{
    table_block table{
        .title = "Static receivers",
        .text = fmt::format(
            "Visibility over the whole shutter interval, against ray tracing with motion blur, on the ground behind "
            "all "
            "casters and at random heights among them. Totals are what all ranges of a texel hide together: a receiver "
            "behind all of them needs no list. Accumulated maps keep the depths of a texel side by side, since a "
            "static "
            "receiver reads all of them at one place. A tent shutter opens and closes evenly; its reference is traced "
            "at "
            "times as dense as the shutter is open. Errors are in thousandths of visibility, over receivers that are "
            "neither "
            "lit nor shadowed all of the time. The ratio is the time of {} rays over that of the method.\n\n{}",
            least_rays, winners(rows)),
        .columns = {{.key = "speed", .label = "speed", .digits = 0},
                    {.key = "receivers", .label = "receivers"},
                    {.key = "method", .label = "method"},
                    {.key = "bytes", .label = "bytes per texel", .digits = 1},
                    {.key = "build", .label = "map, ms", .digits = 0},
                    {.key = "ns", .label = "ns per receiver", .digits = 0},
                    {.key = "rmse", .label = "RMSE", .digits = 2, .scale = 1e3},
                    {.key = "ratio", .label = "ratio", .digits = 1}},
        .rows = {}};
    std::vector<const report_row*> ordered;
    for (const report_row& row : rows) ordered.push_back(&row);
    std::ranges::stable_sort(ordered,
                             [](const report_row* a, const report_row* b) { return place_of(*a) < place_of(*b); });
    for (const report_row* row : ordered)
        table.rows.push_back({.cells = {{"speed", row->parameters.at("speed")},
                                        {"receivers", words_of_part(row->part)},
                                        {"method", row->label},
                                        {"bytes", row->bytes_per_texel},
                                        {"build", row->build_ms},
                                        {"ns", row->ns_per_receiver},
                                        {"rmse", row->errors.rmse},
                                        {"ratio", ns_of_rays(rows, place_of(*row)) / row->ns_per_receiver}},
                              .colour = registry_of<family>().at(row->family).colour});
    return table;
}

} // namespace gnomon::evaluation
