// What soft shadows cost: per texel of a map, and per receiver for searches of several widths.
#pragma once

#include "evaluation/core/blocks.hpp"
#include "soft_stage.hpp"

#include <string>
#include <vector>

namespace gnomon::evaluation {

// Maps of five resolutions hold the stage's depths over and over.
chart_block cost_of_texels(const soft_stage& stage, int finest_resolution);

// Of the methods with these ids. The light grows with the search, so that penumbrae fill the search region.
chart_block cost_of_receivers(const soft_stage& stage, const std::vector<std::string>& ids);

} // namespace gnomon::evaluation
