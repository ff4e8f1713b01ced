// Percentage-closer filtering of 3 x 3 bilinear look-ups while the shutter is open, against the mean over very many
// shadow maps under the same filter: what is left is what a method does to time.
#pragma once

#include "motion_comparison.hpp"

namespace gnomon::evaluation {

// Facts for the gallery, {"scene": s, "title": s, "maps": n of the reference, "methods": [s]}, and rows for the report,
// whose reference is "filtered".
motion_results compare_wide_filters(const motion_sizes& size);

} // namespace gnomon::evaluation
