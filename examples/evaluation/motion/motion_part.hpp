// Parts of the page on shadows in motion as the registry knows them. A part is one file in parts/: what is measured, and
// the blocks that show what was found.
#pragma once

#include "evaluation/core/blocks.hpp"
#include "evaluation/core/report.hpp"
#include "motion_view.hpp"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::evaluation {

struct motion_settings {
    motion_sizes size;
    std::filesystem::path folder; // of the page
    int tasks_at_once = 1;
};

struct part_results {
    std::vector<report_row> rows{};
    std::vector<block> blocks{};
    std::optional<shown_picture> front{}; // on the gallery's front page
};

// Tasks may run at the same time, each on one core. results() is called when all of them have ended.
struct part_run {
    std::vector<std::function<void()>> tasks;
    std::function<part_results()> results;
};

struct motion_part {
    using kind = motion_part;
    static constexpr const char* kind_name = "part of the page on motion";

    std::string id, label;
    double order = 0;
    part_run (*begin)(const motion_settings& how) = nullptr;
};

// Runs the tasks, so many at once. Throws what a task has thrown.
void run_tasks(const std::vector<std::function<void()>>& tasks, int at_once);

} // namespace gnomon::evaluation
