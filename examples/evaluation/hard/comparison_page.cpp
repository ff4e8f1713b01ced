#include "comparison_page.hpp"

#include "evaluation/core/receivers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace gnomon::evaluation {

const report_row& compared_method::row(const std::string& reference, const std::string& part, bool by_packs) const
{
    const report_row* found = nullptr;
    for (const report_row& r : rows)
        if (r.reference == reference && r.part == part &&
            (found == nullptr || (by_packs ? r.lanes > found->lanes : r.lanes < found->lanes)))
            found = &r;
    if (found == nullptr) throw std::logic_error(fmt::format("no row of {} against {}", of->id, reference));
    return *found;
}

bool compared_method::is_filterable() const { return dynamic_cast<const filterable_method*>(of) != nullptr; }

namespace {

// An error statistic as tables and charts show it.
struct statistic {
    const char *key, *label;
    double error_statistics::*of;
};
constexpr statistic rmse{"rmse", "RMSE", &error_statistics::rmse};
constexpr statistic leak{"leak", "leak (mean of what is too bright)", &error_statistics::leak};
constexpr statistic acne{"acne", "acne (mean of what is too dark)", &error_statistics::acne};
constexpr std::array charted{rmse, leak, acne};

class page_of {
  public:
    explicit page_of(const compared_stage& stage) : stage_(stage), first_(stage.references.front()->id) {}

    page operator()() const
    {
        const auto& entry = registry_of<driver>().at(stage_.facts.driver);
        const compared_method& best = shown(1);
        page result{.driver = entry.id,
                    .title = entry.of == subject::model ? entry.label + ": " + stage_.title : entry.label,
                    .family = "hard",
                    .summary = stage_.facts.summary,
                    .front = shown_picture{best.file + ".png", picture_alt(best), best.of->label},
                    .blocks = {}};
        result.blocks = {introduction(), choices()};
        for (const hard_reference* r : stage_.references) result.blocks.push_back(speed(*r, r->uses_depths));
        result.blocks.push_back(kernels());
        result.blocks.push_back(comparison_numbers(stage_));
        for (const compared_method& m : stage_.methods) result.blocks.push_back(pictures(m));
        return result;
    }

  private:
    std::string scene_label() const { return registry_of<scene_entry>().at(stage_.facts.scene).label; }

    const compared_method& shown(std::size_t which) const
    {
        const auto found = std::ranges::find(stage_.methods, stage_.facts.first[which],
                                             [](const compared_method& m) { return m.of->id; });
        return found == stage_.methods.end() ? stage_.methods.front() : *found;
    }

    text_block introduction() const
    {
        const settings& how = stage_.how;
        const int samples = how.supersampling * how.supersampling;
        return {
            .title = {},
            .text = fmt::format(
                "{}\n\nThe picture has {} x {} pixels with {} sample{} each and {} receivers. The shadow map has {} x "
                "{} "
                "texels with 4 samples each, a Gaussian of {} taps in two passes, mip levels and a trilinear look-up, "
                "all rounded to the storage format. The depth bias is the rise of the receiver's plane within {:g} "
                "texels, equal for all methods. No method over-darkens.",
                registry_of<scene_entry>().at(stage_.facts.scene).text, how.width, how.height, samples,
                samples > 1 ? "s" : "", stage_.receivers, how.map_resolution, how.map_resolution, stage_.taps,
                renderer::bias_radius)};
    }

    std::string picture_alt(const compared_method& m) const
    {
        const error_statistics& e = m.row(first_).errors;
        return fmt::format("{}, shadowed by {}: {:.2g} too bright and {:.2g} too dark on average", scene_label(),
                           m.of->label, e.leak, e.acne);
    }

    std::vector<std::pair<std::string, std::string>> inset_key() const
    {
        std::vector<std::pair<std::string, std::string>> result;
        for (const compared_part& part : stage_.insets) result.emplace_back(part.colour, part.name);
        return result;
    }

    pictures_block choices() const
    {
        pictures_block result{.title = "Two methods side by side", .columns = 2, .compare = true, .pictures = {}};
        for (const hard_reference* r : stage_.references)
            result.pictures.push_back(
                {r->id + ".png", fmt::format("{}, shadowed by {}", scene_label(), r->label), "reference: " + r->label});
        std::array<int, 2> first{0, 1};
        for (const compared_method& m : stage_.methods) {
            for (std::size_t k = 0; k < 2; ++k)
                if (&m == &shown(k)) first[k] = static_cast<int>(result.pictures.size());
            result.pictures.push_back({m.file + ".png", picture_alt(m), m.of->label});
        }
        result.shown = std::pair(first[0], first[1]);
        result.key = inset_key();
        return result;
    }

    // Panels of each charted error against a time.
    std::vector<panel> panels(const hard_reference& r, bool filterable_only, bool kernel_alone) const
    {
        std::vector<panel> result;
        for (const statistic& s : charted) {
            panel p{.title = {},
                    .x = {.label = kernel_alone ? "ns per receiver, kernel alone" : "ns per receiver, with the look-up",
                          .scale = scale::log},
                    .y = {.label = s.label, .scale = scale::log},
                    .pareto = true,
                    .series = {}};
            p.size = "bytes per texel";
            double least = 1;
            for (const compared_method& m : stage_.methods) {
                if (filterable_only && !m.is_filterable()) continue;
                const report_row& row = m.row(r.id, {}, true);
                const double error = row.errors.*s.of, time = kernel_alone ? *row.ns_kernel : row.ns_per_receiver;
                least = std::min(least, error);
                p.series.push_back({.label = m.of->label,
                                    .colour = m.of->its_family().colour,
                                    .points = {{time, error, m.of->format.bytes_per_texel}}});
            }
            if (least < 1e-5) p.y.scale = scale::symlog, p.y.threshold = 1e-5;
            result.push_back(std::move(p));
        }
        return result;
    }

    // The methods that none other beats in both coordinates, from the fastest to the most exact, in words.
    static std::string front_in_words(const panel& p)
    {
        std::vector<const series*> sorted;
        for (const series& s : p.series) sorted.push_back(&s);
        std::ranges::sort(sorted, {}, [](const series* s) { return s->points[0]; });
        std::string result;
        double least = 2;
        for (const series* s : sorted) {
            if (s->points[0][1] >= least) continue;
            least = s->points[0][1];
            result +=
                fmt::format("{}{} ({:.2g} at {:.3g} ns)", result.empty() ? "" : ", ", s->label, least, s->points[0][0]);
        }
        return result;
    }

    chart_block charted_block(const std::string& name, const std::string& title, std::vector<panel> panels,
                              const std::string& caption) const
    {
        chart_block result{.title = title, .text = {}, .name = name, .alt = {}, .caption = caption, .panels = {}};
        result.alt = fmt::format(
            "Error against time per receiver in three panels, RMSE, leak and acne. On the front of "
            "RMSE, from the fastest to the most exact: {}.",
            front_in_words(panels.front()));
        result.panels = std::move(panels);
        return result;
    }

    // A reference that uses depths knows reconstruction error alone; it is of no use to judge a method that is not filterable.
    chart_block speed(const hard_reference& r, bool reconstruction_alone) const
    {
        chart_block result = charted_block(
            "speed-" + r.id, "Speed against accuracy: " + r.label, panels(r, reconstruction_alone, false),
            reconstruction_alone
                ? "Reconstruction error alone: the reference filters with exactly the same weights. Lower left is "
                  "better. "
                  "Receivers are looked up and shaded by packs on one core."
                : "Everything: filter width, depth bias and resolution of the map are errors too. A method without a "
                  "filterable map samples the whole filter region for each receiver, one receiver at a time.");
        result.is_front = reconstruction_alone && stage_.facts.is_front;
        return result;
    }

    chart_block kernels() const
    {
        return charted_block(
            "speed-kernel", "Speed of the kernels alone", panels(*stage_.references.front(), true, true),
            "The time from fetched and filtered values to a shadow, by packs on one core: what is left "
            "where a texture unit filters for nothing.");
    }

    pictures_block pictures(const compared_method& m) const
    {
        pictures_block result{
            .title = fmt::format("{}, {}", m.of->label, m.of->format.label), .columns = 3, .pictures = {}};
        result.is_folded = true;
        result.pictures.push_back({m.file + ".png", picture_alt(m), "shadows"});
        for (const hard_reference* r : stage_.references) {
            const error_statistics& e = m.row(r->id).errors;
            result.pictures.push_back(
                {fmt::format("{}-{}.png", m.file, r->id),
                 fmt::format(
                     "Errors of {} against {}: {:.2g} too bright and {:.2g} too dark on average, at most {:.2g}",
                     m.of->label, r->label, e.leak, e.acne, e.max_abs),
                 "errors against " + r->label});
        }
        result.key = inset_key();
        result.key.emplace_back("#2a62cc", fmt::format("light that leaks; full colour at {:g}", error_scale));
        result.key.emplace_back("#c8232c", "too dark");
        return result;
    }

    const compared_stage& stage_;
    std::string first_; // id of the reference of most numbers
};

} // namespace

page comparison_page(const compared_stage& stage) { return page_of(stage)(); }

} // namespace gnomon::evaluation
