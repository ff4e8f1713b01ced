// Stochastic transparency: depth maps into which a fragment is drawn with a probability of its opacity, in each of the four
// samples of a texel for itself, in any order (Enderton et al. 2010).
#pragma once

#include "evaluation/translucent/method.hpp"

namespace gnomon::evaluation {

depth_map stochastic_depths(const translucent_occluders& occluders, const build_settings& how);

} // namespace gnomon::evaluation
