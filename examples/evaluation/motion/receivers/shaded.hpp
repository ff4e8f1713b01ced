// Receivers in closed form along their paths, for light that changes while shadows do. The lists of the map are resolved.
#pragma once

#include "evaluation/motion/light_receivers.hpp"

#include <gnomon/passes/range/map.hpp>

namespace gnomon::evaluation {

// The mean of visibility times the cosine to the light, which is linear in time, over the mean of the cosines at both
// ends of the path, those below 0 taken as 0. Times that mean, as renderer::shade() does, it is the light.
float shaded_visibility(const range_map<float>& map, const light_receiver& r);

} // namespace gnomon::evaluation
