// How a receiver asks a shadow map of ranges: at one time, by samples in time, at rest, or in closed form; each with
// the four texels around it, bilinearly weighed. All give the visibility of the light, 1 lit and 0 in shadow, over the
// segment's own time.
#pragma once

#include "light_receivers.hpp"
#include "range_maps.hpp"

namespace gnomon::evaluation {

// At one time in the segment's. What lies outside of the map is lit.
float visibility_at(const range_map<float>& map, const light_receiver& r, float t);

// The same where the map has covers: a list is asked where there is none.
float cover_first_visibility_at(const range_shadow_map& map, const light_receiver& r, float t);

// By n = max(2 |p_e - p_s|, 5) samples in the middle of their strata (Palmer 2011, 4.1).
float sampled_visibility(const range_map<float>& map, const light_receiver& r);

// As if it stayed where it is halfway. The lists are resolved.
float resting_visibility(const range_map<float>& map, const light_receiver& r);

// As in the thesis: in closed form where both ends are in one texel, by samples elsewhere. The lists are resolved.
float semi_analytic_visibility(const range_map<float>& map, const light_receiver& r);

// In closed form along the way. The lists are resolved.
float light_visibility(const range_map<float>& map, const light_receiver& r);

// The same by percentage-closer filtering of 3 x 3 bilinear look-ups.
float wide_visibility(const range_map<float>& map, const light_receiver& r);

} // namespace gnomon::evaluation
