#include "scattering_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace gnomon::evaluation {

namespace {

cell optional(const std::optional<double>& value) { return value ? cell(*value) : cell(); }

cell pass_of(const scattering_row_set& m, std::string_view name)
{
    for (const build_pass& p : m.passes)
        if (p.name == name) return p.milliseconds;
    return {};
}

double fastest(const scattering_row_set& m)
{
    return std::min(m.traced().ns_per_receiver, m.traced({}, true).ns_per_receiver);
}

class blocks_of_scene {
  public:
    explicit blocks_of_scene(const compared_scattering_scene& scene) : scene_(scene) {}

    std::vector<block> operator()(const std::array<std::string, 2>& first) const
    {
        return {choices(first), speed(), numbers(), errors()};
    }

  private:
    std::vector<std::pair<std::string, std::string>> key_of_places() const
    {
        std::vector<std::pair<std::string, std::string>> result;
        for (const scattering_part& part : scene_.parts) result.emplace_back(part.colour, part.name);
        return result;
    }

    pictures_block choices(const std::array<std::string, 2>& first) const
    {
        pictures_block result{
            .title = scene_.scene.label,
            .text = fmt::format("{}\n\n{} view rays. Magnified places show the light from the air alone, its contrast "
                                "stretched by {:g} about the mean colour of the reference.",
                                scene_.scene.text, scene_.receivers, double(inset_contrast)),
            .columns = 2,
            .compare = true,
            .pictures = {}};
        const char* reference = scattering_references[1].label;
        result.pictures.push_back({scene_.picture, fmt::format("{}, by {}", scene_.scene.label, reference),
                                   fmt::format("reference: {}", reference)});
        std::array<int, 2> shown{0, 1};
        for (const scattering_row_set& m : scene_.methods) {
            for (std::size_t k = 0; k < 2; ++k)
                if (m.of->id == first[k]) shown[k] = static_cast<int>(result.pictures.size());
            result.pictures.push_back({m.picture, alt_of(scene_, m), escaped(m.of->label)});
        }
        result.shown = std::pair(shown[0], shown[1]);
        result.key = key_of_places();
        return result;
    }

    chart_block speed() const
    {
        panel p{.title = {},
                .x = {.label = "ns per view ray, with the look-up", .scale = scale::log},
                .y = {.label = "RMSE against ray tracing", .scale = scale::log},
                .pareto = true,
                .series = {}};
        p.size = "bytes of the map";
        for (const scattering_row_set& m : scene_.methods)
            p.series.push_back({.label = m.of->label,
                                .colour = m.of->its_family().colour,
                                .points = {{fastest(m), m.traced().errors.rmse, m.traced().map_bytes}}});
        return {.title = {},
                .text = {},
                .name = "speed-" + scene_.scene.id,
                .alt = fmt::format("Error against time per view ray of {} methods for {}.", scene_.methods.size(),
                                   scene_.scene.label),
                .caption =
                    "View rays one after the other or by packs, whichever is faster, on one core, without the "
                    "build. Lower left is better.",
                .panels = {std::move(p)}};
    }

    table_block numbers() const
    {
        table_block result{.title = fmt::format("Numbers: {}", scene_.scene.label),
                           .text =
                               "Errors of visibility in thousandths. The best of each column is marked; a click on a "
                               "head sorts.",
                           .columns = {},
                           .rows = {},
                           .is_folded = true};
        const auto add = [&](std::string key, std::string label, int digits, double scale, std::string hint = {}) {
            result.columns.push_back({.key = std::move(key),
                                      .label = std::move(label),
                                      .digits = digits,
                                      .scale = scale,
                                      .best = best::low,
                                      .hint = std::move(hint)});
        };
        result.columns.push_back({.key = "method", .label = "method"});
        for (const scattering_reference& r : scattering_references) {
            const std::string id = r.id, hint = fmt::format("against {}", r.label);
            add("rmse_" + id, "RMSE, " + id, 2, 1e3, hint);
            add("leak_" + id, "leak, " + id, 2, 1e3, "the mean of what is too bright, " + hint);
            add("acne_" + id, "acne, " + id, 2, 1e3, "the mean of what is too dark, " + hint);
        }
        add("max", "largest", 0, 1e3, "against the second reference");
        for (const scattering_part& part : scene_.parts) {
            add(part.id, "RMSE: " + part.name, 2, 1e3, "against the second reference");
            result.columns.back().colour = part.colour;
        }
        add("ns", "ns", 1, 1, "nanoseconds per view ray with the look-up, one after the other");
        add("ns_packs", "ns, packs", 1, 1, "the same by packs of view rays");
        add("ns_kernel", "ns, kernels", 1, 1, "nanoseconds of the kernels alone, from fetched values");
        add("ns_kernel_packs", "ns, kernels, packs", 1, 1, "the same by packs of view rays");
        for (const char* pass : {"rectify", "prefix", "mips"})
            add(pass, fmt::format("{}, ms", pass), 1, 1, "milliseconds of the pass on one core");
        add("build_ms", "build, ms", 1, 1, "all passes");
        add("map_mib", "map, MiB", 2, 1);
        for (const scattering_row_set& m : scene_.methods) result.rows.push_back(row_of_table(m));
        return result;
    }

    table_row row_of_table(const scattering_row_set& m) const
    {
        const report_row &first = m.traced(), &packs = m.traced({}, true);
        table_row result{{{"method", m.of->label},
                          {"max", first.errors.max_abs},
                          {"ns", first.ns_per_receiver},
                          {"ns_kernel", optional(first.ns_kernel)},
                          {"build_ms", first.build_ms},
                          {"map_mib", first.map_bytes / 0x1p20}},
                         m.of->its_family().colour};
        const auto add = [&](std::string key, const cell& value) { result.cells.emplace_back(std::move(key), value); };
        for (const scattering_reference& r : scattering_references) {
            const report_row* row = m.find(r.id);
            const std::string id = r.id;
            add("rmse_" + id, row != nullptr ? cell(row->errors.rmse) : cell());
            add("leak_" + id, row != nullptr ? cell(row->errors.leak) : cell());
            add("acne_" + id, row != nullptr ? cell(row->errors.acne) : cell());
        }
        for (const scattering_part& part : scene_.parts) add(part.id, m.traced(part.id).errors.rmse);
        for (const char* pass : {"rectify", "prefix", "mips"}) add(pass, pass_of(m, pass));
        const bool by_packs = packs.lanes > first.lanes;
        add("ns_packs", by_packs ? cell(packs.ns_per_receiver) : cell());
        add("ns_kernel_packs", by_packs ? optional(packs.ns_kernel) : cell());
        return result;
    }

    pictures_block errors() const
    {
        pictures_block result{.title = fmt::format("Errors: {}", scene_.scene.label),
                              .text = "Against ray tracing.",
                              .columns = 3,
                              .pictures = {},
                              .is_folded = true};
        for (const scattering_row_set& m : scene_.methods) {
            const error_statistics& e = m.traced().errors;
            result.pictures.push_back(
                {m.error,
                 fmt::format("Errors of {}: {:.2g} too bright and {:.2g} too dark on average, at most {:.2g}",
                             m.of->label, e.leak, e.acne, e.max_abs),
                 escaped(m.of->label)});
        }
        result.key = key_of_places();
        for (auto& colour : key_of_errors()) result.key.push_back(std::move(colour));
        return result;
    }

    const compared_scattering_scene& scene_;
};

} // namespace

std::string alt_of(const compared_scattering_scene& scene, const scattering_row_set& method)
{
    const error_statistics& e = method.traced().errors;
    return fmt::format("{}, by {}: {:.2g} too bright and {:.2g} too dark on average", scene.scene.label,
                       method.of->label, e.leak, e.acne);
}

std::vector<block> blocks_of(const compared_scattering_scene& scene, const std::array<std::string, 2>& first)
{
    return blocks_of_scene(scene)(first);
}

block block_of(const compared_scattering_scene& scene, const paper_figure& figure)
{
    pictures_block result{.title = fmt::format("Figure {} of the paper", figure.number),
                          .text = figure.text,
                          .columns = 2,
                          .pictures = {}};
    for (const std::string& id : figure.methods)
        for (const scattering_row_set& m : scene.methods)
            if (m.of->id == id) result.pictures.push_back({m.picture, alt_of(scene, m), escaped(m.of->label)});
    return result;
}

std::vector<std::pair<std::string, std::string>> key_of_errors()
{
    return {{"#2a62cc", fmt::format("too bright; full colour at {:g}", double(scattering_error_scale))},
            {"#c8232c", "too dark"}};
}

} // namespace gnomon::evaluation
