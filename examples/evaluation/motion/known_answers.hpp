// Scenes whose answer is known without a ray: shadow maps of resolved ranges against their closed forms.
#pragma once

#include "motion_comparison.hpp"

namespace gnomon::evaluation {

// A row each with reference "closed-form": the trapezoid at receivers that project to texel centres, and the lit ramp
// at all that a camera sees.
std::vector<report_row> known_answers(const motion_sizes& size);

} // namespace gnomon::evaluation
