// One moving stage by every method, beside the mean of ray tracing at many times.
#pragma once

#include "evaluation/core/blocks.hpp"
#include "evaluation/core/report.hpp"
#include "motion_scene.hpp"
#include "motion_view.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::evaluation {

// A row of the report, and the files of its pictures; empty where it has none.
struct scene_row {
    report_row row;
    std::string format{}; // for people
    std::string picture{}, error{};
};

struct scene_results {
    scene_facts scene;
    motion_scene_facts motion;
    std::size_t triangles = 0, surfaces = 0; // surfaces are counted where the scene has the tag
    long long receivers = 0;
    std::string reference{}; // file of the picture
    std::vector<scene_row> rows{};
    std::vector<shown_picture>
        close_ups{}; // of the reference, semi-analytic and analytic receivers, and of their errors
};

// Visibility at which the colours of errors saturate, and their gain in pictures from close by.
inline constexpr float error_scale = 0.1f;
inline constexpr int close_up_gain = 4;

// Leaves pictures in the folder.
scene_results compare_scene(const scene_facts& scene, const motion_scene_facts& motion,
                            const renderer::moving_stage& stage, const motion_sizes& size,
                            const std::filesystem::path& folder);

// A row by its ids and by all of its parameters, or a null pointer.
const scene_row* find_row(const scene_results& in, std::string_view method, std::string_view receiver,
                          const parameters& with = {});

// Resolved ranges with analytic receivers, the method that the page shows first, and accumulation, which a reader knows.
const scene_row& analytic_row(const scene_results& in);
const scene_row& accumulated_row(const scene_results& in);

} // namespace gnomon::evaluation
