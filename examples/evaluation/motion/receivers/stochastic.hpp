// Receivers at one time, one for each sample of the camera (Hong & Oh 2017), by the four texels around them, bilinearly
// weighed. What lies outside of the map is lit.
#pragma once

#include "evaluation/motion/light_receivers.hpp"
#include "evaluation/motion/range_maps.hpp"

namespace gnomon::evaluation {

float visibility_at(const range_map<float>& map, const light_receiver& r, float t);

// Visibility by a map with covers: the list of a texel is read where its cover does not decide.
float cover_first_visibility_at(const range_shadow_map& map, const light_receiver& r, float t);

} // namespace gnomon::evaluation
