// Errors that move: changes between frames of a camera that moves past a gate, and between two pictures of which one has an
// object more (Peters et al. 2017, Figures 17 and 18).
#pragma once

#include "scattering_comparison.hpp"

#include <string>
#include <vector>

namespace gnomon::evaluation {

// Blocks of a page, and rows of changes between frames. At the gate, estimates and references are the sizes of changes at points
// that are seen in the first of two frames: leak is the mean change beyond that of the reference. Elsewhere they are the changes
// of pixels.
struct compared_frames {
    std::vector<block> blocks;
    std::vector<report_row> rows;
};

inline constexpr int gate_frames = 4;
inline constexpr float gate_frame_time = 0.1f; // in the time of the stage

// Steps that each begins.
std::size_t steps_of_gate_frames();
std::size_t steps_of_entering_frames();

// Rows are those of the compared scene with other errors.
compared_frames compare_gate_frames(const compared_scattering_scene& gate, const std::filesystem::path& folder,
                                    steps& all);
compared_frames compare_entering_frames(const compared_scattering_scene& entering, const std::filesystem::path& folder,
                                        steps& all);

} // namespace gnomon::evaluation
