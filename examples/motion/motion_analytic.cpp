// Shadows in motion by intervals of time, after Palmer 2011 and Hong & Oh: every scene by every method, known answers,
// and what maps take.
#include <string>
#include <vector>

#include "cube_curves.hpp"
#include "drivers.hpp"
#include "known_answers.hpp"
#include "motion_comparison.hpp"
#include "resting_receivers.hpp"
#include "toolbox/file.hpp"
#include "toolbox/moving_stages.hpp"

void gnomon::demo::motion_analytic(const settings& how)
{
    const motion_sizes size = motion_sizes_of(how);
    const std::filesystem::path folder = how.out / "gallery" / "motion_analytic";
    nlohmann::ordered_json facts = facts_of(size);
    std::vector<toolbox::report_row> rows;
    for (const toolbox::listed_stage& listed : toolbox::moving_stages()) {
        const motion_results found = compare_motion({std::string(listed.key), std::string(listed.title)},
                                                    listed.make(double(size.width) / size.height), size, folder);
        facts["scenes"].push_back(found.facts);
        rows.insert(rows.end(), found.rows.begin(), found.rows.end());
    }
    progress("motion_analytic", "known answers");
    for (const toolbox::report_row& row : known_answers(size)) {
        facts["closed_forms"].push_back({{"scene", row.scene},
                                         {"method", row.method},
                                         {"receivers", row.receivers},
                                         {"max_abs", row.errors.max_abs}});
        rows.push_back(row);
    }
    progress("motion_analytic", "receivers at rest");
    const motion_results resting = compare_resting_receivers(size);
    facts["static"] = resting.facts;
    rows.insert(rows.end(), resting.rows.begin(), resting.rows.end());
    progress("motion_analytic", "memory and time of maps against number and speed of cubes");
    facts["memory"] = cube_curves(cube_cases(), 2 * size.map_resolution);
    toolbox::write_file(folder / "facts.json", facts.dump(1));
    toolbox::merge_report(how.out / "report.json", rows);
}
