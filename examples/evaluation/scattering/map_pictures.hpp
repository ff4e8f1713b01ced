// Pictures of shadow maps and of rectified maps (Peters et al. 2017, Figures 13 and 21).
#pragma once

#include "evaluation/core/blocks.hpp"
#include "scattering_view.hpp"

#include <filesystem>

namespace gnomon::evaluation {

// The light's map with the bounds of rectified coordinates, and a rectified map of four moments before and after prefix averages.
block rectification_block(const scattering_view& view, const std::filesystem::path& folder);

// The bounds of view rays in the light's map, where the direction of the light lies outside the view and where it lies inside.
block bounds_block(const scattering_view& outside, const scattering_view& inside, const std::filesystem::path& folder);

} // namespace gnomon::evaluation
