// The page of translucent occluders.
#include "comparison.hpp"
#include "evaluation/core/driver.hpp"
#include "evaluation/core/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace gnomon::evaluation {

const report_row& compared_translucent_method::row(const std::string& reference, const std::string& part,
                                                   const parameters& of_row, bool by_packs) const
{
    const report_row* found = nullptr;
    for (const report_row& r : rows)
        if (r.reference == reference && r.part == part && r.parameters == of_row &&
            (found == nullptr || (by_packs ? r.lanes > found->lanes : r.lanes < found->lanes)))
            found = &r;
    if (found == nullptr)
        throw std::logic_error(fmt::format("no row of {} against {} in '{}'", of->id, reference, part));
    return *found;
}

const report_row& compared_translucent_method::row(const std::string& reference, const std::string& part,
                                                   const showing& how, bool by_packs) const
{
    parameters of_row = how.parameters();
    if (!of->is.between_bounds) of_row.erase("overestimation");
    return row(reference, part, of_row, by_packs);
}

const compared_translucent_method& translucent_comparison::method(const std::string& id) const
{
    const auto found = std::ranges::find(
        methods, id, [](const compared_translucent_method& m) -> const std::string& { return m.of->id; });
    if (found == methods.end()) throw std::logic_error("no method for translucent occluders has the id " + id);
    return *found;
}

namespace {

class page_of {
  public:
    explicit page_of(const translucent_comparison& all) : all_(all) {}

    page operator()() const
    {
        const std::string front = "msm4_float_blended-both.png";
        page result{
            .driver = "translucent",
            .title = registry_of<driver>().at("translucent").label,
            .family = "hard",
            .summary =
                "Shadows of smoke and stained glass by filterable shadow maps into which translucent fragments are "
                "blended.",
            .front = shown_picture{front, picture_alt(all_.method("msm4_float_blended"), showings[3]), "MSM 128 bit"},
            .blocks = {}};
        result.blocks = {introduction(), choices(), order_of_the_paper()};
        result.blocks.push_back(
            artifacts("Leaks on surfaces", "leak-on-surfaces", all_.on_surfaces,
                      "After Figure 6a of the paper: the wall behind the smoke and a pipe, where many layers make the "
                      "distribution of depths complex. Undivided intensities leak, and division by 95% hides the "
                      "fainter leaks."));
        result.blocks.push_back(artifacts("Leaks in the smoke", "leak-in-smoke", all_.in_smoke,
                                          "After Figure 6b of the paper, without the two-pass Gaussian: the silhouette "
                                          "of a pipe behind the smoke makes distributions more complex, so that "
                                          "stripes along the silhouette are lit in the smoke before it."));
        result.blocks.push_back(mending_table(all_));
        result.blocks.push_back(speed());
        result.blocks.push_back(close_up());
        result.blocks.push_back(cost_table(all_));
        result.blocks.push_back(number_table(all_));
        for (const compared_translucent_method& m : all_.methods) result.blocks.push_back(pictures(m));
        return result;
    }

  private:
    text_block introduction() const
    {
        const scene_facts& scene = registry_of<scene_entry>().at("translucent");
        return {.title = {},
                .text = fmt::format(
                    "{}\n\nThe picture has {} x {} pixels and {} receivers. The shadow map has {} x {} texels, {} "
                    "fragments, up to {} of them in a texel, a Gaussian of {} taps in two passes, mip levels and a "
                    "trilinear look-up. Opaque surfaces are drawn with 4 samples per texel and resolved, then "
                    "fragments are blended in the storage format. Methods that know no colours take the mean "
                    "opacity.\n\nThe reference <i>filtered</i> is the exact transmittance of the same stacks under the "
                    "same filter weights: reconstruction error alone. <i>Traced</i> is the transmittance along rays: "
                    "filter width, depth bias and resolution are errors, too.\n\nSurfaces show the lower bound on the "
                    "shadow. Layers of smoke show the lower bound as well, as in the paper, or the middle of both "
                    "bounds, which has half the worst error.",
                    scene.text, all_.width, all_.height, all_.receivers, all_.map_resolution, all_.map_resolution,
                    all_.fragments, all_.layers, all_.taps)};
    }

    std::string picture_alt(const compared_translucent_method& m, const showing& how) const
    {
        const error_statistics &surfaces = m.row("filtered", "surfaces", how).errors,
                               &smoke = m.row("filtered", "smoke", how).errors;
        return fmt::format(
            "Smoke, pipes and stained glass by {}, {}: {:.2g} too bright on surfaces and {:.2g} in the smoke, {:.2g} "
            "too dark in the smoke on average",
            m.of->label, how.label, surfaces.leak, smoke.leak, smoke.acne);
    }

    std::vector<std::pair<std::string, std::string>> inset_key() const
    {
        std::vector<std::pair<std::string, std::string>> result;
        for (const view_inset& inset : all_.insets) result.emplace_back(inset.colour, inset.label);
        return result;
    }

    static std::vector<std::pair<std::string, std::string>> error_key()
    {
        return {{"#2a62cc", fmt::format("light that leaks; full colour at {:g}", translucent_error_scale)},
                {"#c8232c", "too dark"}};
    }

    pictures_block choices() const
    {
        pictures_block result{.title = "Two methods side by side", .columns = 2, .compare = true, .pictures = {}};
        result.pictures = {
            {"traced.png", "Smoke, pipes and stained glass, with the transmittance of traced rays",
             "reference: ray tracing"},
            {"filtered.png", "Smoke, pipes and stained glass, with the exact transmittance of filtered stacks",
             "reference: filtered stacks"}};
        for (const compared_translucent_method& m : all_.methods)
            for (const showing& how : pictured)
                if (is_drawn(*m.of, how))
                    result.pictures.push_back({fmt::format("{}-{}.png", m.of->id, how.id), picture_alt(m, how),
                                               fmt::format("{}, {}", m.of->label, how.label)});
        const auto place = [&](const std::string& file) {
            return static_cast<int>(std::ranges::find(result.pictures, file, &shown_picture::file) -
                                    result.pictures.begin());
        };
        result.shown = std::pair(place("msm4_unorm16_paper_blended-divided.png"), place("filtered.png"));
        result.key = inset_key();
        return result;
    }

    double rmse(const std::string& id, const std::string& part, const showing& how = showings[0]) const
    {
        return all_.method(id).row("filtered", part, how).errors.rmse;
    }
    double leak(const std::string& id, const std::string& part, const showing& how = showings[0]) const
    {
        return all_.method(id).row("filtered", part, how).errors.leak;
    }

    // The paper's findings about its Figure 5, each with the figures of this run and whether they agree.
    table_block order_of_the_paper() const
    {
        const std::string vsm = "vsm_unorm16_blended", evsm = "evsm_half_blended", evsm128 = "evsm_float_blended",
                          msm = "msm4_unorm16_paper_blended", msm128 = "msm4_float_blended";
        table_block result{
            .title = "What the paper finds",
            .text =
                "Statements of Peters et al. 2017, Section 3.3, about their Figure 5, and the figures here, without "
                "division, against <i>filtered</i>. All methods underestimate the shadow, so darker is closer.",
            .columns = {{.key = "finding", .label = "the paper"},
                        {.key = "figures", .label = "here"},
                        {.key = "holds", .label = "holds"}},
            .rows = {}};
        const auto add = [&](const char* finding, const std::string& figures, bool holds) {
            result.rows.push_back({{{"finding", finding}, {"figures", figures}, {"holds", holds ? "yes" : "no"}}});
        };
        const auto in_smoke = [&](const std::string& id) { return leak(id, "smoke"); };
        const auto on_surfaces = [&](const std::string& id) { return leak(id, "surfaces"); };
        const auto behind = [&](const std::string& id) { return rmse(id, "behind"); };
        const auto on_pipes = [&](const std::string& id) { return leak(id, "pipes"); };
        add("64-bit moments have the darkest self-shadowing in the smoke",
            fmt::format("leak in the smoke: VSM {:.3f}, EVSM {:.3f} and {:.3f}, MSM {:.3f}", in_smoke(vsm),
                        in_smoke(evsm), in_smoke(evsm128), in_smoke(msm)),
            in_smoke(msm) < std::min({in_smoke(vsm), in_smoke(evsm), in_smoke(evsm128)}));
        add("64-bit moments leak least on the pipes",
            fmt::format("leak on the pipes: VSM {:.3f}, EVSM {:.3f} and {:.3f}, MSM {:.3f}", on_pipes(vsm),
                        on_pipes(evsm), on_pipes(evsm128), on_pipes(msm)),
            on_pipes(msm) < std::min({on_pipes(vsm), on_pipes(evsm), on_pipes(evsm128)}));
        add("variance shadow maps leak unacceptably on opaque surfaces",
            fmt::format("leak on surfaces: VSM {:.3f}, EVSM {:.3f} and {:.3f}, MSM {:.3f}", on_surfaces(vsm),
                        on_surfaces(evsm), on_surfaces(evsm128), on_surfaces(msm)),
            on_surfaces(vsm) > std::max({on_surfaces(evsm), on_surfaces(evsm128), on_surfaces(msm)}));
        add("variance shadow maps reconstruct the shadows that the smoke casts almost as well as 64-bit moments",
            fmt::format("RMSE on surfaces behind smoke or glass: VSM {:.3f}, EVSM {:.3f} and {:.3f}, MSM {:.3f}",
                        behind(vsm), behind(evsm), behind(evsm128), behind(msm)),
            behind(vsm) - behind(msm) < std::min(behind(evsm), behind(evsm128)) - behind(vsm));
        add("variance shadow maps shadow the smoke itself almost as well as 64-bit moments",
            fmt::format("RMSE in the smoke: VSM {:.3f}, EVSM {:.3f} and {:.3f}, MSM {:.3f}", rmse(vsm, "smoke"),
                        rmse(evsm, "smoke"), rmse(evsm128, "smoke"), rmse(msm, "smoke")),
            rmse(vsm, "smoke") < std::min(rmse(evsm, "smoke"), rmse(evsm128, "smoke")));
        add("the higher exponent of 128-bit exponential variance makes leaks worse",
            fmt::format("leak in the smoke {:.4f} with 64 bit, {:.4f} with 128; on the pipes {:.4f} and {:.4f}",
                        in_smoke(evsm), in_smoke(evsm128), on_pipes(evsm), on_pipes(evsm128)),
            in_smoke(evsm128) >= in_smoke(evsm) && on_pipes(evsm128) > on_pipes(evsm));
        add("128-bit moments are not beneficial",
            fmt::format("RMSE in the smoke: {:.4f} with 64 bit, {:.4f} with 128", rmse(msm, "smoke"),
                        rmse(msm128, "smoke")),
            rmse(msm128, "smoke") > 0.95 * rmse(msm, "smoke"));
        return result;
    }

    static pictures_block artifacts(const char* title, const char* name, const std::vector<artifact_picture>& shown,
                                    const char* text)
    {
        pictures_block result{.title = title, .text = text, .columns = 4, .pictures = {}};
        for (const char* reference : {"filtered", "traced"})
            result.pictures.push_back({fmt::format("{}-{}.png", name, reference),
                                       fmt::format("{}: the reference, {}", title, reference),
                                       fmt::format("reference: {}", reference)});
        for (const artifact_picture& one : shown) {
            const std::string alt = fmt::format("{}: {}, {:.3f} too bright and {:.3f} too dark on average", title,
                                                one.label, one.leak, one.acne);
            result.pictures.push_back({one.name + ".png", alt, fmt::format("{}: leak {:.3f}", one.label, one.leak)});
            result.pictures.push_back({one.name + "-error.png", "Errors of " + alt, "its errors"});
        }
        result.key = error_key();
        return result;
    }

    chart_block speed() const
    {
        chart_block result{.title = "Speed against accuracy",
                           .name = "speed",
                           .alt = {},
                           .caption =
                               "Receivers are looked up and shaded by packs on one core, percentage-closer filtering "
                               "one receiver at a time. Lower left is better.",
                           .panels = {}};
        const auto add = [&](const char* title, const char* part, const showing& how) {
            panel p{.title = title,
                    .x = {.label = "ns per receiver, with the look-up", .scale = scale::log},
                    .y = {.label = "RMSE against filtered stacks", .scale = scale::log},
                    .pareto = true,
                    .series = {}};
            p.size = "bytes per texel";
            for (const compared_translucent_method& m : all_.methods)
                p.series.push_back(
                    {.label = m.of->label,
                     .colour = m.of->its_family().colour,
                     .points = {{m.row("filtered", "", showings[0], true).ns_per_receiver,
                                 m.row("filtered", part, how).errors.rmse, m.of->format.bytes_per_texel}}});
            result.panels.push_back(std::move(p));
        };
        add("smoke, lower bound", "smoke", showings[0]);
        add("smoke, middle of the bounds", "smoke", showings[2]);
        add("surfaces, lower bound, divided by 95%", "surfaces", showings[1]);
        result.alt = fmt::format(
            "RMSE against time per receiver in three panels. In the smoke, from the lower bound to the middle: the "
            "paper's MSM 64 bit {:.3f} to {:.3f}, MSM 128 bit {:.3f} to {:.3f}, six moments in floats {:.3f} to "
            "{:.3f}, absorbance {:.3f} to {:.3f}.",
            rmse("msm4_unorm16_paper_blended", "smoke"), rmse("msm4_unorm16_paper_blended", "smoke", showings[2]),
            rmse("msm4_float_blended", "smoke"), rmse("msm4_float_blended", "smoke", showings[2]),
            rmse("msm6_float_blended", "smoke"), rmse("msm6_float_blended", "smoke", showings[2]),
            rmse("absorbance4_float", "smoke"), rmse("absorbance4_float", "smoke", showings[2]));
        return result;
    }

    pictures_block close_up() const
    {
        return {.title = "The smoke from close by",
                .text = fmt::format(
                    "The paper measures the cost of its transform where many layers of smoke cover a pixel. Here a "
                    "pixel has {:.1f} receivers in the smoke on average. The table of costs has the time of a pixel.",
                    all_.close_up_overdraw),
                .columns = 1,
                .pictures = {{"close-up.png", "The smoke fills the picture; each layer is lit by itself", "traced"}}};
    }

    pictures_block pictures(const compared_translucent_method& m) const
    {
        pictures_block result{
            .title = fmt::format("{}, {}", m.of->label, m.of->format.label), .columns = 3, .pictures = {}};
        result.is_folded = true;
        for (const showing& how : pictured) {
            if (!is_drawn(*m.of, how)) continue;
            const std::string name = fmt::format("{}-{}", m.of->id, how.id);
            result.pictures.push_back({name + ".png", picture_alt(m, how), how.label});
            for (const char* reference : {"filtered", "traced"}) {
                const error_statistics& e = m.row(reference, "", how).errors;
                result.pictures.push_back(
                    {fmt::format("{}-{}-error.png", name, reference),
                     fmt::format("Errors of {}, {}, against {}: {:.2g} too bright and {:.2g} too dark on average",
                                 m.of->label, how.label, reference, e.leak, e.acne),
                     fmt::format("errors against {}", reference)});
            }
        }
        result.key = inset_key();
        result.key.emplace_back("#2a62cc",
                                fmt::format("light that leaks; full colour at {:g}", translucent_error_scale));
        result.key.emplace_back("#c8232c", "too dark");
        return result;
    }

    const translucent_comparison& all_;
};

} // namespace

page translucent_page(const translucent_comparison& all) { return page_of(all)(); }

} // namespace gnomon::evaluation
