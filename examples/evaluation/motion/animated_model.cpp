#include "evaluation/core/drivers.hpp"
#include "motion_comparison.hpp"
#include "renderer/import/model.hpp"
#include "renderer/output/file.hpp"
#include "renderer/scene/moving_stages.hpp"

#include <string>

void gnomon::evaluation::animated_model(const settings& how, const std::filesystem::path& file,
                                        std::string_view animation, const std::array<double, 2>& shutter)
{
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
    renderer::merge_report(how.out / "report.json", found.rows);
}
