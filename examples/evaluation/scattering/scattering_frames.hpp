// Errors that move: changes between frames of a camera that moves past a gate, and between two pictures of which one has an
// object more (Peters et al. 2017, Figures 17 and 18).
#pragma once

#include "scattering_page.hpp"

namespace gnomon::evaluation {

inline constexpr int gate_frames = 4;
inline constexpr float gate_frame_time = 0.1f; // in the time of the stage

// Steps that each begins.
std::size_t steps_of_gate_frames();
std::size_t steps_of_entering_frames();

// Rows are those of the compared scene with errors of changes. At the gate, estimates and references are the sizes of changes at
// points that are seen in the first of two frames: leak is the mean change beyond that of the reference. Elsewhere they are the
// changes of pixels.
page_part compare_gate_frames(const compared_scattering_scene& gate, const std::filesystem::path& folder, steps& all);
page_part compare_entering_frames(const compared_scattering_scene& entering, const std::filesystem::path& folder,
                                  steps& all);

} // namespace gnomon::evaluation
