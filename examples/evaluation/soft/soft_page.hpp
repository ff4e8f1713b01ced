// Blocks of a stage that is shadowed by every method of soft shadows.
#pragma once

#include "soft_comparison.hpp"

#include <string>
#include <vector>

namespace gnomon::evaluation {

// Two methods side by side, of which these two are first seen; numbers; speed against accuracy; every method's pictures.
std::vector<block> blocks_of(const compared_soft_scene& scene, const std::array<std::string, 2>& first);

// What there is to see of a picture, for those who cannot see it.
std::string alt_of(const compared_soft_scene& scene, const soft_row_set& method);

} // namespace gnomon::evaluation
