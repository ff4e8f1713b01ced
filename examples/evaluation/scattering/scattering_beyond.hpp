// Single scattering where the paper does not go: in air that thins out with height, and before each of several translucent
// surfaces (forward shading). Rows are those of scenes of their own, against ray tracing.
#pragma once

#include "scattering_page.hpp"

namespace gnomon::evaluation {

// Steps that each begins.
std::size_t steps_of_fog();
std::size_t steps_of_layers();

// The room and the trees in height fog, by rows whose weights follow the fog and by rows of homogeneous air.
page_part compare_fog(const settings& given, const std::filesystem::path& folder, steps& all);

// Translucent veils in the room: each surface of a pixel has a look-up of its own.
page_part compare_layers(const settings& how, const std::filesystem::path& folder, steps& all);

} // namespace gnomon::evaluation
