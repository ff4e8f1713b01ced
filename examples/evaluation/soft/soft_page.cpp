#include "soft_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace gnomon::evaluation {

namespace {

cell optional(const std::optional<double>& value) { return value ? cell(*value) : cell(); }

class blocks_of_scene {
  public:
    explicit blocks_of_scene(const compared_soft_scene& scene) : scene_(scene) {}

    std::vector<block> operator()(const std::array<std::string, 2>& first) const
    {
        return {choices(first), speed(), numbers(), pictures()};
    }

  private:
    std::vector<std::pair<std::string, std::string>> key_of_places() const
    {
        std::vector<std::pair<std::string, std::string>> result;
        for (const soft_part& part : scene_.parts) result.emplace_back(part.colour, part.name);
        return result;
    }

    pictures_block choices(const std::array<std::string, 2>& first) const
    {
        pictures_block result{
            .title = scene_.scene.label,
            .text =
                fmt::format("{}\n\n{} receivers. A blocker at the near plane makes a penumbra of {:.0f} texels on the "
                            "farthest receiver.",
                            scene_.scene.text, scene_.receivers, scene_.widest_penumbra),
            .columns = 2,
            .compare = true,
            .pictures = {}};
        const auto add = [&](const std::string& file, std::string alt, std::string caption) {
            result.pictures.push_back({file, std::move(alt), std::move(caption)});
        };
        for (std::size_t k = 0; k < soft_references.size(); ++k)
            add(scene_.pictures[k], fmt::format("{}, shadowed by {}", scene_.scene.label, soft_references[k].label),
                fmt::format("reference: {}", soft_references[k].label));
        std::array<int, 2> shown{0, 1};
        for (const soft_row_set& m : scene_.methods) {
            for (std::size_t k = 0; k < 2; ++k)
                if (m.of->id == first[k]) shown[k] = static_cast<int>(result.pictures.size());
            add(m.picture, alt_of(scene_, m), m.of->label);
            if (!m.unbiased.empty())
                add(m.unbiased, alt_of(scene_, m) + "; here without depth bias", m.of->label + ", without depth bias");
        }
        result.shown = std::pair(shown[0], shown[1]);
        result.key = key_of_places();
        return result;
    }

    chart_block speed() const
    {
        chart_block result{
            .title = {}, .text = {}, .name = "speed-" + scene_.scene.id, .alt = {}, .caption = {}, .panels = {}};
        for (const soft_reference& r : soft_references) {
            panel p{.title = std::string(r.id) == "filtered" ? "reconstruction alone" : "everything: ray tracing",
                    .x = {.label = "ns per receiver, with the look-ups", .scale = scale::log},
                    .y = {.label = "RMSE", .scale = scale::log},
                    .pareto = true,
                    .series = {}};
            p.size = "bytes per texel";
            for (const soft_row_set& m : scene_.methods) {
                const report_row& row = m.row(r.id);
                p.series.push_back({.label = m.of->label,
                                    .colour = m.of->its_family().colour,
                                    .points = {{std::min(row.ns_per_receiver, m.row(r.id, {}, true).ns_per_receiver),
                                                row.errors.rmse, row.bytes_per_texel}}});
            }
            result.panels.push_back(std::move(p));
        }
        result.alt = fmt::format("Error against time per receiver of {} methods for {}, in two panels.",
                                 scene_.methods.size(), scene_.scene.label);
        result.caption =
            "Receivers one after the other or by packs, whichever is faster, on one core. Lower left is better.";
        return result;
    }

    table_block numbers() const
    {
        table_block result{.title = fmt::format("Numbers: {}", scene_.scene.label),
                           .text =
                               "Errors of visibility in thousandths. The best of each column is marked; a click on a "
                               "head sorts.",
                           .columns = {},
                           .rows = {}};
        const auto add = [&](std::string key, std::string label, int digits, double scale, std::string hint = {}) {
            result.columns.push_back({.key = std::move(key),
                                      .label = std::move(label),
                                      .digits = digits,
                                      .scale = scale,
                                      .best = best::low,
                                      .hint = std::move(hint)});
        };
        result.columns.push_back({.key = "method", .label = "method"});
        for (const soft_reference& r : soft_references) {
            const std::string id = r.id, hint = fmt::format("against {}", r.label);
            add("rmse_" + id, "RMSE, " + id, 2, 1e3, hint);
            add("leak_" + id, "leak, " + id, 2, 1e3, "the mean of what is too bright, " + hint);
            add("acne_" + id, "acne, " + id, 2, 1e3, "the mean of what is too dark, " + hint);
        }
        add("acne_unbiased", "acne without bias", 2, 1e3, "against the first reference, both without depth bias");
        for (const soft_part& part : scene_.parts) {
            add(part.id, "RMSE: " + part.name, 2, 1e3, "against the second reference");
            result.columns.back().colour = part.colour;
        }
        add("ns", "ns", 1, 1, "nanoseconds per receiver with the look-ups, one after the other");
        add("ns_packs", "ns, packs", 1, 1, "the same by packs of receivers");
        add("ns_kernel", "ns, kernels", 1, 1, "nanoseconds of the kernels alone, from fetched values");
        add("ns_kernel_packs", "ns, kernels, packs", 1, 1, "the same by packs of receivers");
        add("build_ms", "map, ms", 1, 1, "resolve and table, on one core");
        add("map_mib", "map, MiB", 1, 1);
        result.columns.push_back({.key = "umbra",
                                  .label = "umbra, %",
                                  .digits = 1,
                                  .scale = 100,
                                  .hint = "receivers whose look-up ends with the search, in the umbra"});
        result.columns.push_back({.key = "lit",
                                  .label = "lit, %",
                                  .digits = 1,
                                  .scale = 100,
                                  .hint = "receivers whose look-up ends with the search, in full light"});
        for (const soft_row_set& m : scene_.methods) result.rows.push_back(row_of_table(m));
        result.is_folded = true;
        return result;
    }

    table_row row_of_table(const soft_row_set& m) const
    {
        const report_row &first = m.row(soft_references[0].id), &packs = m.row(soft_references[0].id, {}, true);
        table_row result{{{"method", m.of->label},
                          {"acne_unbiased", optional(first.acne_unbiased)},
                          {"ns", first.ns_per_receiver},
                          {"ns_kernel", optional(first.ns_kernel)},
                          {"build_ms", first.build_ms},
                          {"map_mib", first.map_bytes / 0x1p20}},
                         m.of->its_family().colour};
        for (const soft_reference& r : soft_references) {
            const error_statistics& e = m.row(r.id).errors;
            const std::string id = r.id;
            result.cells.insert(result.cells.end(),
                                {{"rmse_" + id, e.rmse}, {"leak_" + id, e.leak}, {"acne_" + id, e.acne}});
        }
        for (const soft_part& part : scene_.parts)
            result.cells.emplace_back(part.id, m.row(soft_references[1].id, part.id).errors.rmse);
        const bool by_packs = packs.lanes > first.lanes;
        result.cells.emplace_back("ns_packs", by_packs ? cell(packs.ns_per_receiver) : cell());
        result.cells.emplace_back("ns_kernel_packs", by_packs ? optional(packs.ns_kernel) : cell());
        result.cells.emplace_back("umbra", m.skipped ? cell(m.skipped->umbra) : cell());
        result.cells.emplace_back("lit", m.skipped ? cell(m.skipped->lit) : cell());
        return result;
    }

    pictures_block pictures() const
    {
        pictures_block result{.title = fmt::format("Errors: {}", scene_.scene.label), .columns = 2, .pictures = {}};
        result.is_folded = true;
        for (const soft_row_set& m : scene_.methods)
            for (std::size_t k = 0; k < soft_references.size(); ++k) {
                const error_statistics& e = m.row(soft_references[k].id).errors;
                result.pictures.push_back(
                    {m.errors[k],
                     fmt::format(
                         "Errors of {} against {}: {:.2g} too bright and {:.2g} too dark on average, at most {:.2g}",
                         m.of->label, soft_references[k].label, e.leak, e.acne, e.max_abs),
                     fmt::format("{}, against the reference <i>{}</i>", escaped(m.of->label), soft_references[k].id)});
            }
        result.key = key_of_places();
        result.key.emplace_back("#2a62cc", fmt::format("too bright; full colour at {:g}", soft_error_scale));
        result.key.emplace_back("#c8232c", "too dark");
        return result;
    }

    const compared_soft_scene& scene_;
};

} // namespace

std::string alt_of(const compared_soft_scene& scene, const soft_row_set& method)
{
    const error_statistics& e = method.row(soft_references[1].id).errors;
    return fmt::format("{}, shadowed by {}: {:.2g} too bright and {:.2g} too dark on average", scene.scene.label,
                       method.of->label, e.leak, e.acne);
}

std::vector<block> blocks_of(const compared_soft_scene& scene, const std::array<std::string, 2>& first)
{
    return blocks_of_scene(scene)(first);
}

} // namespace gnomon::evaluation
