// Shadows in motion by intervals of time, after Palmer 2011 and Hong & Oh: all parts of the page, from their registry.
#include "evaluation/core/driver.hpp"
#include "scene_blocks.hpp"

#include <algorithm>
#include <optional>
#include <thread>
#include <utility>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace gnomon::evaluation {

namespace {

// Two, where they fit into memory: times are of one core each.
int tasks_at_once(const motion_sizes& size)
{
    return size.map_resolution < 1024 && std::thread::hardware_concurrency() > 1 ? 2 : 1;
}

// Maps are freed and allocated many times; memory that the system has taken back has to be cleared each time.
void keep_memory()
{
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 1 << 30);
    mallopt(M_TRIM_THRESHOLD, 1 << 30);
#endif
}

constexpr const char* introduction =
    "While a shutter is open, everything moves along straight lines. A shadow map of ranges keeps for each texel what "
    "the "
    "light sees: from one time to another, from one depth to another. The time for which a receiver is lit is an "
    "integral in "
    "closed form, with no noise and no bands. Accumulation, the common method, is the mean over ordinary shadow maps "
    "at "
    "some "
    "times. <i>Time-dependent</i> shadow maps (Akenine-Möller et al. 2007) have a sample for each texel and slice of "
    "the "
    "shutter interval, at a time of its own.\n\n"
    "Maps keep all ranges, <i>exact</i> by edge functions in time or by <i>prisms</i> (Hong &amp; Oh, <i>Motion "
    "Blurred "
    "Shadows Utilizing a Depth-Time Ranges Shadow Map</i>), each also <i>with coverage</i>, without what is hidden "
    "while the "
    "shutter is open (Hong &amp; Oh, <i>Efficient Motion Blurred Shadows Using a Temporal Shadow Map</i>, 2017). Or "
    "they are "
    "<i>resolved</i> to what is in front at each time, those of <i>casters</i> without what is behind all else. Or "
    "<i>lists</i> of a fixed capacity merge what is most similar (Gribel et al. 2010; Palmér, <i>Analytical Motion "
    "Blurred "
    "Shadows</i>, 2011). Receivers look a map up at one time for each sample of the camera, or for all the time in "
    "which a "
    "pixel sees a surface: as if the surface were static, by samples, in closed form within a texel (semi-analytic), "
    "or in "
    "closed form along its path (analytic). Scenes are from these papers and from Andersson et al., <i>Filtered "
    "Stochastic "
    "Shadow Mapping Using a Layered Approach</i> (2015).\n\n";

void motion_analytic(const settings& how)
{
    keep_memory();
    const motion_sizes size = motion_sizes_of(how);
    const motion_settings with{size, how.folder("motion_analytic"), tasks_at_once(size)};
    std::vector<part_run> parts;
    std::vector<std::function<void()>> tasks;
    std::optional<steps> all;
    for (const motion_part* part : registry_of<motion_part>().all()) {
        parts.push_back(part->begin(with));
        for (const auto& one : parts.back().tasks)
            tasks.emplace_back([one, &all, part] {
                all->begin(part->label);
                one();
            });
    }
    all.emplace("motion_analytic", tasks.size());
    run_tasks(tasks, with.tasks_at_once);
    page shown{.driver = "motion_analytic",
               .title = "Shadows in motion",
               .family = "motion",
               .summary =
                   "Shadows of what moves while the shutter is open: intervals of time in closed form, against the "
                   "mean over many shadow maps.",
               .blocks = {text_block{.text = introduction + words_of(with)}}};
    std::vector<report_row> rows;
    for (const part_run& part : parts) {
        part_results found = part.results();
        if (found.front) shown.front = std::move(found.front);
        std::ranges::move(found.rows, std::back_inserter(rows));
        std::ranges::move(found.blocks, std::back_inserter(shown.blocks));
    }
    write_page(with.folder, shown);
    merge_report(how.out / "report.json", rows);
}

const registered<driver> entry{
    driver{.id = "motion_analytic", .label = "Shadows in motion", .order = 60, .run = motion_analytic}};

} // namespace

} // namespace gnomon::evaluation
