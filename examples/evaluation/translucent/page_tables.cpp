// The tables of the page of translucent occluders.
#include "comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace gnomon::evaluation {

namespace {

// Nothing where the picture is so small that no receiver is in the inset.
cell inset_leak(const compared_translucent_method& m, const view_inset& inset, const showing& how)
{
    const bool is_there = std::ranges::count(m.rows, inset.id, &report_row::part) > 0;
    return is_there ? cell(m.row("filtered", inset.id, how).errors.leak) : cell();
}

} // namespace

// How much each choice takes off the leaks of the paper's method.
table_block mending_table(const translucent_comparison& all)
{
    table_block result{
        .title = "What mends the leaks",
        .text =
            "Errors of visibility in thousandths against <i>filtered</i>, beside those of the paper's method. The "
            "library's formats allow for the roundings of all blends, so that none darkens a surface by more than it "
            "states, which costs leaks where there are few bits. The best of each column is marked.",
        .columns = {{.key = "method", .label = "method"}},
        .rows = {}};
    const auto column_of = [&](const char* key, const char* label, const char* hint) {
        result.columns.push_back(
            {.key = key, .label = label, .digits = 1, .scale = 1e3, .best = best::low, .hint = hint});
    };
    column_of("smoke", "RMSE, smoke", "of layers of smoke");
    column_of("smoke_leak", "leak, smoke", "the mean of what is too bright");
    column_of("smoke_acne", "acne, smoke", "the mean of what is too dark");
    column_of("surfaces", "RMSE, surfaces", "of opaque surfaces");
    column_of("leak", "leak, surfaces", "the mean of what is too bright");
    column_of("acne", "acne, surfaces", "the mean of what is too dark");
    column_of("behind", "RMSE, behind", "of opaque surfaces behind smoke or glass");
    column_of("behind_leak", "leak, behind", "the mean of what is too bright");
    column_of("pipes", "leak, pipes", "on the pipes");
    for (const view_inset& inset : all.insets) {
        column_of(inset.id.c_str(), "", inset.of_smoke ? "of the smoke" : "of the surfaces");
        result.columns.back().label = "leak: " + inset.label;
        result.columns.back().colour = inset.colour;
    }
    for (const char* id : {"msm4_unorm16_paper_blended", "msm4_unorm16_blended", "msm4_half_blended",
                           "msm4_float_blended", "msm6_unorm10_blended", "msm6_unorm16_blended", "msm6_float_blended",
                           "msm4_unorm16_stochastic", "absorbance4_float"}) {
        const compared_translucent_method& m = all.method(id);
        for (const showing& how : showings) {
            const auto of = [&](const std::string& part) { return m.row("filtered", part, how).errors; };
            table_row cells{{{"method", fmt::format("{}, {}", m.of->label, how.label)},
                             {"smoke", of("smoke").rmse},
                             {"smoke_leak", of("smoke").leak},
                             {"smoke_acne", of("smoke").acne},
                             {"surfaces", of("surfaces").rmse},
                             {"leak", of("surfaces").leak},
                             {"acne", of("surfaces").acne},
                             {"behind", of("behind").rmse},
                             {"behind_leak", of("behind").leak},
                             {"pipes", of("pipes").leak}},
                            m.of->its_family().colour};
            for (const view_inset& inset : all.insets) cells.cells.emplace_back(inset.id, inset_leak(m, inset, how));
            result.rows.push_back(std::move(cells));
        }
    }
    return result;
}

table_block cost_table(const translucent_comparison& all)
{
    table_block result{.title = "What it costs",
                       .text =
                           "A map on one core: resolve, blends, blur and mip levels. The paper's frames take 1.04, "
                           "1.10, 1.26 and 1.12 times as long with blending as without (VSM, EVSM 64 and 128 bit, MSM "
                           "64 bit); these are ratios of the map alone.",
                       .columns = {{.key = "method", .label = "method"}, {.key = "format", .label = "format"}},
                       .rows = {}};
    const auto plain = [&](const char* key, const char* label, int digits, const char* hint) {
        result.columns.push_back({.key = key, .label = label, .digits = digits, .best = best::low, .hint = hint});
    };
    plain("bytes", "bytes per texel", 0, "without mip levels");
    plain("build", "map, ms", 1, "with fragments");
    plain("opaque", "map, ms, opaque", 1, "without fragments");
    plain("ratio", "ratio", 2, "with fragments over without");
    plain("mib", "map, MiB", 1, "with mip levels");
    plain("look_up", "ns, look-up", 1, "nanoseconds per receiver with the look-up, one receiver at a time");
    plain("look_up_packs", "ns, look-up, packs", 1, "the same by packs of receivers");
    plain("kernel", "ns, kernel", 1, "nanoseconds from fetched values to the shadow, one receiver at a time");
    plain("kernel_packs", "ns, kernel, packs", 2, "the same by packs of receivers");
    plain("pixel", "ns, pixel of the close-up", 0, "look-ups of all receivers of a pixel, by packs");
    for (const compared_translucent_method& m : all.methods) {
        const report_row &one = m.row("filtered"), &packs = m.row("filtered", "", showings[0], true);
        const report_row& close = *std::ranges::max_element(m.close_up_rows, {}, &report_row::lanes);
        const bool by_packs = packs.lanes > one.lanes;
        result.rows.push_back({{{"method", m.of->label},
                                {"format", m.of->format.label},
                                {"bytes", one.bytes_per_texel},
                                {"build", one.build_ms},
                                {"opaque", m.opaque_ms},
                                {"ratio", one.build_ms / m.opaque_ms},
                                {"mib", one.map_bytes / 0x1p20},
                                {"look_up", one.ns_per_receiver},
                                {"look_up_packs", by_packs ? cell(packs.ns_per_receiver) : cell()},
                                {"kernel", *one.ns_kernel},
                                {"kernel_packs", by_packs ? cell(*packs.ns_kernel) : cell()},
                                {"pixel", close.ns_per_receiver * all.close_up_overdraw}},
                               m.of->its_family().colour});
    }
    return result;
}

table_block number_table(const translucent_comparison& all)
{
    table_block result{
        .title = "Numbers",
        .text =
            "Errors of visibility in thousandths. Noise is the standard deviation over seeds, for methods that draw "
            "fragments by chance. The alpha test leaves out fragments of an opacity below 1%.",
        .columns = {{.key = "method", .label = "method"}, {.key = "showing", .label = "shows"}},
        .rows = {}};
    const auto column_of = [&](const std::string& key, const std::string& label, const std::string& hint = {}) {
        result.columns.push_back(
            {.key = key, .label = label, .digits = 1, .scale = 1e3, .best = best::low, .hint = hint});
    };
    const std::array<std::pair<const char*, const char*>, 6> columns{{{"", "all"},
                                                                      {"surfaces", "surfaces"},
                                                                      {"behind", "behind"},
                                                                      {"pipes", "pipes"},
                                                                      {"pane", "panes"},
                                                                      {"smoke", "smoke"}}};
    for (const auto& [part, label] : columns) {
        column_of(fmt::format("rmse_{}", part), fmt::format("RMSE, {}", label));
        column_of(fmt::format("leak_{}", part), fmt::format("leak, {}", label));
    }
    column_of("dark", "largest darkness, surfaces", "the most that a surface is too dark");
    column_of("traced", "RMSE, traced", "against ray tracing");
    column_of("noise", "noise, all", "standard deviation over seeds");
    for (const compared_translucent_method& m : all.methods) {
        const auto add = [&](const std::string& shows, const parameters& of_row, bool is_whole) {
            table_row cells{{{"method", m.of->label}, {"showing", shows}}, m.of->its_family().colour};
            const auto of = [&](const char* part) -> const error_statistics& {
                return m.row("filtered", part, of_row).errors;
            };
            for (const auto& [part, label] : columns) {
                const bool is_known =
                    is_whole || *part == '\0' || std::string(part) == "surfaces" || std::string(part) == "smoke";
                cells.cells.emplace_back(fmt::format("rmse_{}", part), is_known ? cell(of(part).rmse) : cell());
                cells.cells.emplace_back(fmt::format("leak_{}", part), is_known ? cell(of(part).leak) : cell());
            }
            const report_row& whole = m.row("filtered", "", of_row);
            cells.cells.emplace_back("dark", of("surfaces").max_dark);
            cells.cells.emplace_back("traced", m.row("traced", "", of_row).errors.rmse);
            cells.cells.emplace_back("noise", whole.noise ? cell(*whole.noise) : cell());
            result.rows.push_back(std::move(cells));
        };
        for (const showing& how : showings)
            if (is_drawn(*m.of, how)) add(how.label, how.parameters(), true);
        if (m.of->is.blended) add("lower bound, 1% alpha test", {{"least_alpha", 0.01}}, false);
    }
    return result;
}

} // namespace gnomon::evaluation
