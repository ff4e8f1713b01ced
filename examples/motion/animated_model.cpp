#include <string>

#include "drivers.hpp"
#include "motion_comparison.hpp"
#include "toolbox/file.hpp"
#include "toolbox/model.hpp"
#include "toolbox/moving_stages.hpp"

void gnomon::demo::animated_model(const settings& how, const std::filesystem::path& file, std::string_view animation,
                                  const std::array<double, 2>& shutter)
{
    const motion_sizes size = motion_sizes_of(how);
    const std::filesystem::path folder = how.out / "gallery" / "animated_model";
    const toolbox::moving_stage scenery = toolbox::animated_model_stage(
        toolbox::load_animated_model(file, animation, shutter[0], shutter[1]), double(size.width) / size.height);
    const motion_results found =
        compare_motion({.key = "model", .title = scenery.world.open.name}, scenery, size, folder);
    nlohmann::ordered_json facts = facts_of(size);
    facts["animation"] = animation;
    facts["shutter"] = shutter;
    facts["scenes"].push_back(found.facts);
    toolbox::write_file(folder / "facts.json", facts.dump(1, ' ', false, nlohmann::json::error_handler_t::replace));
    toolbox::merge_report(how.out / "report.json", found.rows);
}
