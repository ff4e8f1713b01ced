// Shadows in motion by intervals of time, after Palmer 2011 and Hong & Oh: every scene by every method, known answers,
// and what maps take.
#include <atomic>
#include <exception>
#include <functional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "cube_curves.hpp"
#include "evaluation/core/driver.hpp"
#include "known_answers.hpp"
#include "mesh_costs.hpp"
#include "motion_comparison.hpp"
#include "renderer/output/file.hpp"
#include "renderer/scene/moving_stages.hpp"
#include "resting_receivers.hpp"
#include "wide_filter.hpp"

namespace gnomon::evaluation {

namespace {

// Parts of the driver, each on one core; their results are in their order.
class parts {
  public:
    void add(std::function<motion_results()> part)
    {
        parts_.push_back(std::move(part));
        results_.emplace_back();
    }

    std::vector<motion_results> run(std::size_t at_once)
    {
        std::vector<std::exception_ptr> failures(at_once);
        const auto work = [&](std::exception_ptr& failure) {
            try {
                for (std::size_t i = next_++; i < parts_.size(); i = next_++) results_[i] = parts_[i]();
            } catch (...) {
                failure = std::current_exception();
                next_ = parts_.size();
            }
        };
        {
            std::vector<std::jthread> others;
            for (std::size_t i = 1; i < at_once; ++i) others.emplace_back(work, std::ref(failures[i]));
            work(failures[0]);
        }
        for (const std::exception_ptr& failure : failures)
            if (failure) std::rethrow_exception(failure);
        return std::move(results_);
    }

  private:
    std::vector<std::function<motion_results()>> parts_;
    std::vector<motion_results> results_;
    std::atomic<std::size_t> next_ = 0;
};

motion_results answers(const motion_sizes& size)
{
    motion_results result{nlohmann::json::array(), known_answers(size)};
    for (const report_row& row : result.rows)
        result.facts.push_back({{"scene", row.scene},
                                {"method", row.method},
                                {"receivers", row.receivers},
                                {"max_abs", row.errors.max_abs}});
    return result;
}

// Two, where they fit into memory: times are of one core each.
std::size_t parts_at_once(const motion_sizes& size)
{
    return size.map_resolution < 1024 && std::thread::hardware_concurrency() > 1 ? 2 : 1;
}

// Maps are given back and asked for again many times: what the system takes back it has to clear each time.
void keep_memory()
{
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 1 << 30);
    mallopt(M_TRIM_THRESHOLD, 1 << 30);
#endif
}

void motion_analytic(const settings& how)
{
    keep_memory();
    const motion_sizes size = motion_sizes_of(how);
    const std::filesystem::path folder = how.out / "gallery" / "motion_analytic";
    nlohmann::ordered_json facts = facts_of(size);
    parts all;
    std::vector<std::string> names; // where in the facts each part's go
    const auto add = [&](std::string name, std::function<motion_results()> part) {
        names.push_back(std::move(name));
        all.add(std::move(part));
    };
    for (const renderer::listed_stage& listed : renderer::moving_stages())
        add("scenes", [&] {
            const motion_scene scene{.key = std::string(listed.key),
                                     .title = std::string(listed.title),
                                     .surfaces = listed.key == "cubes_to_the_light" || listed.key == "random_cubes",
                                     .cover_first = listed.key == "random_cubes"};
            return compare_motion(scene, listed.make(double(size.width) / size.height), size, folder);
        });
    for (const char* name : {"static", "meshes", "closed_forms"}) facts[name] = nlohmann::json::array();
    for (const float factor : {1.f, 4.f})
        add("static", [&, factor] {
            progress("motion_analytic", "receivers at rest");
            return compare_resting_receivers(size, factor);
        });
    add("meshes", [&] {
        progress("motion_analytic", "meshes");
        return motion_results{mesh_costs(size), {}};
    });
    add("closed_forms", [&] {
        progress("motion_analytic", "known answers");
        return answers(size);
    });
    add("wide_filter", [&] {
        progress("motion_analytic", "a wide filter");
        return compare_wide_filters(size);
    });
    for (const cube_case& some : cube_cases())
        add("memory", [&] {
            if (&some == cube_cases().data())
                progress("motion_analytic", "memory and time of maps against number and speed of cubes");
            return motion_results{cube_costs(some, size.map_resolution), {}};
        });
    facts["memory"] = {
        {"resolution", size.map_resolution}, {"longest", longest_way}, {"rows", nlohmann::json::array()}};
    std::vector<report_row> rows;
    facts["parts_at_once"] = parts_at_once(size);
    const std::vector<motion_results> found = all.run(parts_at_once(size));
    for (std::size_t i = 0; i < found.size(); ++i) {
        const nlohmann::ordered_json& fact = found[i].facts;
        auto& to = names[i] == "memory" ? facts["memory"]["rows"] : facts[names[i]];
        if (fact.is_array()) to.insert(to.end(), fact.begin(), fact.end());
        else if (names[i] == "wide_filter") to = fact;
        else to.push_back(fact);
        rows.insert(rows.end(), found[i].rows.begin(), found[i].rows.end());
    }
    renderer::write_file(folder / "facts.json", facts.dump(1));
    merge_report(how.out / "report.json", rows);
}

const registered<driver> entry{
    driver{.id = "motion_analytic", .label = "Shadows in motion", .order = 60, .run = motion_analytic}};

} // namespace

} // namespace gnomon::evaluation
