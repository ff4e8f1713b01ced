// Pages of blocks: every kind of block with all that it may have, and what is refused.
#include "evaluation/core/blocks.hpp"

#include "renderer/folder.hpp"
#include "renderer/output/file.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <functional>
#include <stdexcept>
#include <utility>

using namespace gnomon::evaluation;
using nlohmann::ordered_json;

namespace {

page some_page()
{
    return {.driver = "some_driver",
            .title = "Title",
            .family = "hard",
            .summary = "One sentence.",
            .front = shown_picture{"a.png", "a box", "A box"},
            .blocks = {text_block{"Head", "a &amp; b"},
                       table_block{.title = "Numbers",
                                   .text = {},
                                   .columns = {{.key = "name", .label = "method"},
                                               {.key = "ns",
                                                .label = "ns",
                                                .digits = 1,
                                                .scale = 1e3,
                                                .best = best::low,
                                                .hint = "time",
                                                .colour = "#111111"}},
                                   .rows = {{{{"name", "PCF"}, {"ns", 0.25}}, "#222222"},
                                            {{{"name", "VSM"}, {"ns", {}}}, {}, true}},
                                   .is_folded = true},
                       pictures_block{.columns = 2,
                                      .compare = true,
                                      .pictures = {{"a.png", "a box"}},
                                      .is_pixelated = true,
                                      .key = {{"#c8232c", "acne"}},
                                      .shown = std::pair(0, 0)},
                       chart_block{.name = "speed",
                                   .alt = "a chart",
                                   .panels = {{.title = "left",
                                               .x = {.label = "ns", .scale = scale::log},
                                               .y = {.label = "error",
                                                     .scale = scale::symlog,
                                                     .threshold = 1e-5,
                                                     .least = 0,
                                                     .most = 1,
                                                     .ticks = {{0.5, "half"}}},
                                               .pareto = true,
                                               .series = {{.label = "PCF",
                                                           .colour = "#222222",
                                                           .points = {{1, 2, 16}},
                                                           .labelled = false,
                                                           .texts = {"16"},
                                                           .dashed = true,
                                                           .marker = "star"},
                                                          {.label = "rules",
                                                           .style = style::rule,
                                                           .points = {{1, std::nan("")}, {std::nan(""), 2}}}},
                                               .size = "bytes"}},
                                   .is_front = true},
                       map_block{.name = "failures",
                                 .alt = "a map",
                                 .x = {{.label = "weight"}, {0, 1}},
                                 .y = {{.label = "distance", .scale = scale::log}, {0.5}},
                                 .threshold = 0.01,
                                 .label = "darkness",
                                 .maps = {{"MSM", {{0.5, std::nullopt}}}}}}};
}

struct driver_folder : temporary_folder {
    driver_folder() { gnomon::renderer::write_file(*this / "a.png", "a picture"); }

    ordered_json written(const page& what) const
    {
        write_page(path, what);
        return ordered_json::parse(gnomon::renderer::read_file(*this / "facts.json"));
    }
};

} // namespace

TEST_CASE("a page has all that its blocks say")
{
    CHECK(driver_folder().written(some_page()) == ordered_json::parse(R"({
        "driver": "some_driver", "title": "Title", "family": "hard", "summary": "One sentence.",
        "front": {"picture": "a.png", "alt": "a box", "caption": "A box"},
        "blocks": [
            {"type": "text", "title": "Head", "text": "a &amp; b"},
            {"type": "table", "title": "Numbers", "folded": true,
             "columns": [{"key": "name", "label": "method"},
                         {"key": "ns", "label": "ns", "digits": 1, "scale": 1000.0, "best": "low", "hint": "time",
                          "colour": "#111111"}],
             "rows": [{"name": "PCF", "ns": 0.25, "colour": "#222222"}, {"name": "VSM", "ns": null, "aside": true}]},
            {"type": "pictures", "columns": 2, "compare": true, "pixelated": true, "shown": [0, 0],
             "key": [{"colour": "#c8232c", "label": "acne"}],
             "pictures": [{"file": "a.png", "alt": "a box", "caption": ""}]},
            {"type": "chart", "name": "speed", "alt": "a chart", "front": true, "panels": [
                {"title": "left", "x": {"label": "ns", "scale": "log"},
                 "y": {"label": "error", "scale": "symlog", "threshold": 1e-5, "least": 0.0, "most": 1.0,
                       "ticks": [[0.5, "half"]]}, "pareto": true, "size": "bytes",
                 "series": [{"label": "PCF", "colour": "#222222", "style": "points", "points": [[1.0, 2.0, 16.0]],
                             "labelled": false, "texts": ["16"], "dashed": true, "marker": "star"},
                            {"label": "rules", "style": "rule", "points": [[1.0, null], [null, 2.0]],
                             "labelled": true}]}]},
            {"type": "map", "name": "failures", "alt": "a map",
             "x": {"label": "weight", "scale": "linear", "values": [0.0, 1.0]},
             "y": {"label": "distance", "scale": "log", "values": [0.5]}, "threshold": 0.01, "label": "darkness",
             "maps": [{"label": "MSM", "values": [[0.5, null]]}]}]})"));
}

TEST_CASE("what a reader would miss is refused, and the file stays")
{
    const driver_folder folder;
    const std::string before = folder.written(some_page()).dump();
    const auto of = []<class Block>(page& p) -> Block& {
        for (block& b : p.blocks)
            if (Block* found = std::get_if<Block>(&b)) return *found;
        throw std::logic_error("no such block");
    };
    const std::pair<const char*, std::function<void(page&)>> cases[]{
        {"the page has no title or no summary", [](page& p) { p.summary.clear(); }},
        {"no picture 'b.png'", [](page& p) { p.front->file = "b.png"; }},
        {"a.png has no text for those who cannot see it", [](page& p) { p.front->alt.clear(); }},
        {"a text is empty", [&](page& p) { of.operator()<text_block>(p).text.clear(); }},
        {"two columns have the key ns", [&](page& p) { of.operator()<table_block>(p).columns[0].key = "ns"; }},
        {"a row has the key rmse, which no column has",
         [&](page& p) { of.operator()<table_block>(p).rows[0].cells[0].first = "rmse"; }},
        {"ns is nan", [&](page& p) { of.operator()<table_block>(p).rows[0].cells[1].second = std::nan(""); }},
        {"no picture 'b.png'", [&](page& p) { of.operator()<pictures_block>(p).pictures[0].file = "b.png"; }},
        {"speed has no text for those who cannot see it", [&](page& p) { of.operator()<chart_block>(p).alt.clear(); }},
        {"PCF is inf", [&](page& p) { of.operator()<chart_block>(p).panels[0].series[0].points[0][1] = HUGE_VAL; }},
        {"a point of PCF is none", [&](page& p) { of.operator()<chart_block>(p).panels[0].series[0].points[0] = {1}; }},
        {"PCF has 2 texts for 1 points",
         [&](page& p) {
             of.operator()<chart_block>(p).panels[0].series[0].texts = {"16", "32"};
         }},
        {"rules is neither upright nor level",
         [&](page& p) {
             of.operator()<chart_block>(p).panels[0].series[1].points[0] = {1, 2};
         }},
        {"two charts or maps have the name 'speed'", [&](page& p) { of.operator()<map_block>(p).name = "speed"; }},
        {"MSM has 1 rows for 2 values of y",
         [&](page& p) {
             of.operator()<map_block>(p).y.values = {1, 2};
         }},
        {"MSM has 2 values for 1 of x", [&](page& p) { of.operator()<map_block>(p).x.values = {1}; }}};
    for (const auto& [cause, change] : cases) {
        CAPTURE(cause);
        page changed = some_page();
        change(changed);
        CHECK_THROWS_WITH_AS(write_page(folder.path, changed), (folder.path.string() + ": " + cause).c_str(),
                             std::invalid_argument);
        CHECK(ordered_json::parse(gnomon::renderer::read_file(folder / "facts.json")).dump() == before);
    }
}

TEST_CASE("escaped text cannot be read as a tag") { CHECK(escaped("<b> & \"c\"") == "&lt;b&gt; &amp; &quot;c&quot;"); }
