#include "evaluation/core/driver.hpp"
#include "renderer/import/model.hpp"
#include "soft_costs.hpp"
#include "soft_page.hpp"
#include "soft_scene.hpp"

#include <fmt/format.h>

namespace gnomon::evaluation {

namespace {

constexpr std::array<const char*, 2> first_seen{"pcss_15", "msm4_soft"};

// Pictures of half the size in the quick setting: rays to the light's area take most of the time. Maps are as large as the
// paper's, since widths of search regions are in their texels.
settings sizes_of(settings how)
{
    how.map_resolution = 1024;
    if (how.supersampling == 1) how.width /= 2, how.height /= 2;
    return how;
}

page page_of(const char* id, const std::string& title, const std::string& summary)
{
    return {.driver = id, .title = title, .family = "soft", .summary = summary, .front = {}, .blocks = {}};
}

text_block introduction(const settings& how)
{
    return {
        .title = {},
        .text = fmt::format(
            "Soft shadows of lights with an area, after Section 4 of Peters et al., <i>Improved Moment Shadow Maps for "
            "Translucent Occluders, Soft Shadows and Single Scattering</i> (JCGT 2017). A look-up searches the shadow "
            "map "
            "for blockers, takes the width of the penumbra from their mean depth, and filters the map over that width. "
            "Moment soft shadows do both by one look-up each into a summed-area table of moments; percentage-closer "
            "soft "
            "shadows (PCSS) go through all texels.\n\nPictures have {} x {} pixels with {} samples each, shadow maps "
            "{} x {} "
            "texels, with 4 samples each for tables and one for PCSS. Search regions are up to {:g} texels wide. The "
            "depth "
            "bias is the rise of the receiver's plane within the filter, so it grows with the penumbra, equally for "
            "all methods. "
            "Two references: PCSS in double on the samples that tables are made of, by the same rectangles, against "
            "which only the reconstruction counts; and {} rays to the light's area.",
            how.width, how.height, how.supersampling * how.supersampling, how.map_resolution, how.map_resolution,
            double(usual_search), usual_rays)};
}

void write(const compared_soft_scene& shown, page& to, std::vector<report_row>& rows)
{
    for (block& b : blocks_of(shown, {first_seen[0], first_seen[1]})) to.blocks.push_back(std::move(b));
    for (const soft_row_set& m : shown.methods) rows.insert(rows.end(), m.rows.begin(), m.rows.end());
}

void soft_shadows(const settings& given)
{
    const settings how = sizes_of(given);
    const std::filesystem::path folder = how.folder("soft_shadows");
    const std::vector<const soft_scene*> scenes = registry_of<scene_entry>().all_of<soft_scene>();
    steps all("soft_shadows", scenes.size() * steps_of_comparison() + 2);
    page result =
        page_of("soft_shadows", "Soft shadows",
                "Soft shadows by moments, two look-ups each, and by percentage-closer soft shadows that go through "
                "every texel: what each costs, and where each fails.");
    result.blocks.push_back(introduction(how));
    std::vector<report_row> rows;
    for (const soft_scene* s : scenes) {
        const renderer::stage scenery = s->stage(double(how.width) / how.height);
        const compared_soft_scene found = compare_soft_methods(*s, scenery, how, folder, all, s->without_bias);
        write(found, result, rows);
        if (s == scenes.front()) {
            const soft_row_set& best = found.method(first_seen[1]);
            result.front = shown_picture{best.picture, alt_of(found, best), best.of->label};
        }
    }
    const renderer::stage scenery = scenes.front()->stage(double(how.width) / how.height);
    const soft_stage stage(scenery, how);
    all.begin("cost per receiver");
    result.blocks.push_back(
        cost_of_receivers(stage, {"pcss_27", "msm4_soft", "msm4_soft_snapped", "msm6_soft", "vssm"}));
    all.begin("cost per texel");
    result.blocks.push_back(cost_of_texels(stage, 4 * how.map_resolution));
    write_page(folder, result);
    merge_report(how.out / "report.json", rows);
}

void soft_model(const settings& given)
{
    const settings how = sizes_of(given);
    renderer::stage scenery =
        renderer::model_stage(renderer::load_model(how.model.file), double(how.width) / how.height);
    scenery.light_size = glm::dvec2(0.06);
    steps all("soft_model", steps_of_comparison());
    page result = page_of("soft_model", fmt::format("A model in soft shadows: {}", scenery.world.name),
                          "A model from a file, shadowed by every method of soft shadows.");
    result.blocks.push_back(introduction(how));
    std::vector<report_row> rows;
    const compared_soft_scene found =
        compare_soft_methods(registry_of<scene_entry>().at("model"), scenery, how, how.folder("soft_model"), all);
    write(found, result, rows);
    const soft_row_set& best = found.method(first_seen[1]);
    result.front = shown_picture{best.picture, alt_of(found, best), best.of->label};
    write_page(how.folder("soft_model"), result);
    merge_report(how.out / "report.json", rows);
}

const registered<driver> entry{driver{.id = "soft_shadows", .label = "Soft shadows", .order = 16, .run = soft_shadows}};
const registered<driver> of_model{driver{
    .id = "soft_model", .label = "A model in soft shadows", .order = 72, .run = soft_model, .of = subject::model}};

} // namespace

} // namespace gnomon::evaluation
