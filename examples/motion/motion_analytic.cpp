// Shadows in motion by intervals of time, after Palmer 2011 and Hong & Oh: every scene by every method, known answers,
// and what maps take.
#include <string>
#include <vector>

#include "drivers.hpp"
#include "motion_comparison.hpp"
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
    toolbox::write_file(folder / "facts.json", facts.dump(1));
    toolbox::merge_report(how.out / "report.json", rows);
}
