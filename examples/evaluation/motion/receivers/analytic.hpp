// Receivers in closed form along their paths. The lists of the map are resolved.
#pragma once

#include "evaluation/motion/light_receivers.hpp"

#include <gnomon/passes/range/map.hpp>

namespace gnomon::evaluation {

// By one bilinear look-up.
float light_visibility(const range_map<float>& map, const light_receiver& r);

// By percentage-closer filtering of 3 x 3 bilinear look-ups.
float wide_visibility(const range_map<float>& map, const light_receiver& r);

} // namespace gnomon::evaluation
