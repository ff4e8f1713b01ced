// Every method of stochastic shadows in one scene, against ray tracing: errors, noise over seeds with the camera's and
// without, what a constant bias does, memory, and the time of each step.
#pragma once

#include "evaluation/core/report.hpp"
#include "evaluation/core/settings.hpp"
#include "evaluation/motion/motion_scene.hpp"
#include "layered_method.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::evaluation {

struct layered_sizes {
    int width, height, map_resolution;
    int reference_times;
    int camera_samples; // of a pixel
    int seeds;          // of methods with equal input; others have fewer
    int few_seeds;      // of rivals of equal time or memory, and of settings
    bool full;
};
layered_sizes layered_sizes_of(const settings& how);

// A variant of a method, at a constant bias beyond the slope's.
struct layered_result {
    const layered_method* method;
    const layered_variant* variant;
    double constant_bias = 0;
    report_row row{};
    double sampling_ms = 0, conversion_ms = 0, look_up_ms = 0; // of one core
    evaluation::parameters facts{};
    std::string picture{}, error{}; // files, or none

    bool is_usual() const { return variant == &method->variants.front(); }
    bool is_of(std::string_view comparison) const;
    double build_ms() const { return sampling_ms + conversion_ms; }
    double total_ms() const { return build_ms() + look_up_ms; }
    std::string label() const;
};

// Errors of a part of the pixels by the constant of the bias.
struct bias_point {
    double constant, leak, acne, rmse;
};
struct bias_curve {
    const layered_method* method;
    const layered_variant* variant;
    std::vector<bias_point> points;

    const bias_point& best() const; // the smallest with at most 1.01 x the least RMSE
};

struct compared_layers {
    scene_facts scene;
    motion_scene_facts motion;
    int map_resolution = 0; // of the usual map
    std::size_t triangles = 0;
    long long receivers = 0, penumbra_pixels = 0, samples_of_map = 0;
    double camera_ms = 0, shading_ms = 0; // of one core
    std::string reference{};              // file
    std::vector<layered_result> results{};
    std::vector<bias_curve> curves{};

    // The result of a method's usual variant, or of the variant with these parameters; at no constant bias, or at the
    // best constant if that is not 0. A null pointer where there is none.
    const layered_result* usual(std::string_view method, bool best_bias = false) const;
    const layered_result* find(std::string_view method, const parameters& how, bool best_bias = false) const;
};

compared_layers compare_layers(const motion_scene& scene, const layered_sizes& size,
                               const std::filesystem::path& folder);

// At this and beyond, colours of errors are full.
inline constexpr float layered_error_scale = 0.25f;

} // namespace gnomon::evaluation
