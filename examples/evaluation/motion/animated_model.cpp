#include "evaluation/core/driver.hpp"
#include "motion_comparison.hpp"
#include "renderer/import/model.hpp"
#include "renderer/output/file.hpp"
#include "renderer/scene/moving_stages.hpp"

#include <string>

namespace gnomon::evaluation {

namespace {

// A model from a file on a ground plane, from one time of an animation to another, by every kind of shadow map of ranges.
void animated_model(const settings& how)
{
    const auto& [file, animation, shutter] = how.model;
    const motion_sizes size = motion_sizes_of(how);
    const std::filesystem::path folder = how.out / "gallery" / "animated_model";
    const renderer::moving_stage scenery = renderer::animated_model_stage(
        renderer::load_animated_model(file, animation, shutter[0], shutter[1]), double(size.width) / size.height);
    const motion_results found =
        compare_motion({.key = "model", .title = scenery.world.open.name}, scenery, size, folder);
    nlohmann::ordered_json facts = facts_of(size);
    facts["animation"] = animation;
    facts["shutter"] = shutter;
    facts["scenes"].push_back(found.facts);
    renderer::write_file(folder / "facts.json", facts.dump(1, ' ', false, nlohmann::json::error_handler_t::replace));
    merge_report(how.out / "report.json", found.rows);
}

const registered<driver> entry{driver{.id = "animated_model",
                                      .label = "A model in motion",
                                      .order = 80,
                                      .run = animated_model,
                                      .of = subject::animation}};

} // namespace

} // namespace gnomon::evaluation
