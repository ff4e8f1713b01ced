// What a receiver at rest costs, and how well its visibility over the whole shutter interval is known: resolved ranges,
// shadow maps at some times, and rays at some times; among random cubes and on the ground below them, behind all of
// them; as fast as they are and faster.
#pragma once

#include "motion_comparison.hpp"

namespace gnomon::evaluation {

// Facts for the gallery, {"factor", "where", "shutter", "method", "bytes_per_texel", "build_ms", "ns", "rmse",
// "ratio"}, ratio: the time of 16 rays over the method's, and rows for the report. RMSE is over receivers that are
// neither lit nor in shadow all of the time. The factor is that of the motion.
motion_results compare_resting_receivers(const motion_sizes& size, float factor);

} // namespace gnomon::evaluation
