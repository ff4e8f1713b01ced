// Changes of stochastic shadows from frame to frame, beyond those of the reference.
#pragma once

#include "evaluation/core/blocks.hpp"
#include "evaluation/core/report.hpp"
#include "layered_comparison.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::evaluation {

// The mean change of a pixel's visibility from one frame to the next, that of the reference, and the root mean square of
// their difference.
struct method_change {
    const layered_method* method;
    std::string label;
    double change, beyond;
};

struct compared_frames {
    scene_facts scene;
    int frames = 0;
    double reference_change = 0;
    std::vector<method_change> methods{};
    std::vector<report_row> rows{}; // in the part "change"
    std::vector<shown_picture> pictures{};
};

// The frames of a shutter of half the scene's, which opens later from frame to frame.
compared_frames compare_frames(const motion_scene& scene, const layered_sizes& size, int frames,
                               const std::filesystem::path& folder);

std::vector<block> blocks_of(const compared_frames& found);

} // namespace gnomon::evaluation
