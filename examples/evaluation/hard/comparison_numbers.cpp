#include "comparison_page.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>

namespace gnomon::evaluation {

namespace {

cell optional(const std::optional<double>& value) { return value ? cell(*value) : cell(); }

} // namespace

table_block comparison_numbers(const compared_stage& stage)
{
    const std::string first = stage.references.front()->id;
    table_block result{
        .title = "Numbers",
        .text = fmt::format(
            "Errors of visibility in thousandths. Where a column says nothing else, the reference is {}. The "
            "best of each column is marked; a click on a head sorts.",
            stage.references.front()->label),
        .columns = {},
        .rows = {}};
    const auto add = [&](column c) { result.columns.push_back(std::move(c)); };
    const auto thousandths = [&](std::string key, std::string label, std::string hint = {}) {
        add({.key = std::move(key),
             .label = std::move(label),
             .digits = 2,
             .scale = 1e3,
             .best = best::low,
             .hint = std::move(hint)});
    };
    const auto plain = [&](std::string key, std::string label, int digits, std::string hint = {}) {
        add({.key = std::move(key),
             .label = std::move(label),
             .digits = digits,
             .best = best::low,
             .hint = std::move(hint)});
    };
    const bool insets_leak = stage.facts.of_insets == "leak";
    add({.key = "method", .label = "method"});
    add({.key = "format", .label = "format"});
    plain("bytes", "bytes per texel", 0);
    thousandths("leak", "leak", "the mean of what is too bright");
    thousandths("acne", "acne", "the mean of what is too dark");
    thousandths("acne_unbiased", "acne without bias", "of the same receivers without depth bias");
    thousandths("max_dark", "largest darkness", "the most that a receiver is too dark");
    thousandths("darkened", "darkened",
                fmt::format("how many of a thousand receivers that are at least half lit are too dark by {:g} "
                            "thousandths or more",
                            1e3 * too_dark));
    for (const compared_part& part : stage.insets) {
        thousandths(part.id, fmt::format("{}: {}", stage.facts.of_insets, part.name));
        result.columns.back().colour = part.colour;
    }
    for (const hard_reference* r : stage.references)
        thousandths("rmse_" + r->id, "RMSE, " + r->id, "against " + r->label);
    plain("ns_look_up", "ns, look-up", 1, "nanoseconds per receiver with the look-up, one receiver at a time");
    plain("ns_look_up_packs", "ns, look-up, packs", 1, "the same by packs of receivers");
    plain("ns_kernel", "ns, kernel", 1, "nanoseconds from fetched values to the shadow, one receiver at a time");
    plain("ns_kernel_packs", "ns, kernel, packs", 2, "the same by packs of receivers");
    plain("build_ms", "map, ms", 0, "resolve, blur and mip levels, on one core");
    plain("map_mib", "map, MiB", 1, "with mip levels");
    for (const compared_method& m : stage.methods) {
        const report_row &row = m.row(first), &packs = m.row(first, {}, true);
        const error_statistics& e = row.errors;
        table_row cells{{{"method", m.of->label},
                         {"format", m.of->format.label},
                         {"bytes", row.bytes_per_texel},
                         {"leak", e.leak},
                         {"acne", e.acne},
                         {"acne_unbiased", optional(row.acne_unbiased)},
                         {"max_dark", e.max_dark},
                         {"darkened", e.darkened},
                         {"ns_look_up", row.ns_per_receiver},
                         {"ns_kernel", optional(row.ns_kernel)},
                         {"build_ms", row.build_ms},
                         {"map_mib", row.map_bytes / 0x1p20}},
                        m.of->its_family().colour};
        for (const compared_part& part : stage.insets) {
            const error_statistics& within = m.row(first, part.id).errors;
            cells.cells.emplace_back(part.id, insets_leak ? within.leak : within.darkened);
        }
        for (const hard_reference* r : stage.references)
            cells.cells.emplace_back("rmse_" + r->id, m.row(r->id).errors.rmse);
        const bool by_packs = packs.lanes > row.lanes;
        cells.cells.emplace_back("ns_look_up_packs", by_packs ? cell(packs.ns_per_receiver) : cell());
        cells.cells.emplace_back("ns_kernel_packs", by_packs ? optional(packs.ns_kernel) : cell());
        cells.is_aside = !m.is_filterable();
        result.rows.push_back(std::move(cells));
    }
    return result;
}

} // namespace gnomon::evaluation
