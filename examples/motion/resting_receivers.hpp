// What a receiver at rest costs, and how well its visibility over the whole shutter interval is known: resolved ranges,
// shadow maps at some times, and rays at some times; on the ground below random cubes, as fast as they are and faster.
#pragma once

#include "motion_comparison.hpp"

namespace gnomon::demo {

// Facts for the gallery, {"factor", "method", "ns", "rmse", "ratio"}, ratio: the time of 16 rays over the method's, and
// rows for the report. RMSE is over receivers that are neither lit nor in shadow all of the time.
motion_results compare_resting_receivers(const motion_sizes& size);

} // namespace gnomon::demo
