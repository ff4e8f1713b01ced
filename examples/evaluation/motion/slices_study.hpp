// Time-dependent shadow maps of one stage by numbers of samples and by depth slice_biases, beside ranges at the same samples.
#pragma once

#include "evaluation/core/blocks.hpp"
#include "evaluation/core/report.hpp"
#include "motion_part.hpp"
#include "renderer/scene/moving_scene.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace gnomon::evaluation {

struct sliced_case {
    std::string id, label;
    int pictured; // samples, as in the paper's picture
};

struct bias_kind {
    const char *label, *colour;
};
inline constexpr std::array slice_biases{bias_kind{"slope", "#d62728"}, bias_kind{"dynamic bias, (12)", "#ff9896"},
                                         bias_kind{"slope and motion", "#8c1c13"}};

struct sweep_point {
    double constant, leak, acne, rmse;
};

// A kind of bias at one number of samples: without a constant, at the best constant, and for all constants.
struct bias_result {
    error_statistics errors{};
    double look_up_ms = 0;
    std::size_t bytes = 0;
    std::vector<sweep_point> sweep{};

    const sweep_point& best() const { return *std::ranges::min_element(sweep, {}, &sweep_point::rmse); }
};

// Results for a number of samples of map and camera.
struct count_result {
    int samples;
    double shadow_ms, camera_ms;
    std::array<bias_result, slice_biases.size()> by_bias{};
    double ranges_ms = 0; // look-ups of ranges at the same samples
    error_statistics ranges{};
};

struct sliced_results {
    sliced_case what;
    std::size_t triangles = 0, ranges_bytes = 0, building_bytes = 0;
    double ranges_build_ms = 0;
    long long receivers = 0;
    int resolution = 0; // of the map
    std::vector<count_result> by_count{};
    std::vector<shown_picture> pictures{};
};

// Leaves pictures in the folder.
sliced_results study_slices(const sliced_case& what, const renderer::moving_stage& stage, const motion_settings& how);

} // namespace gnomon::evaluation
