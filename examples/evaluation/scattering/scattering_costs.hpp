// What single scattering costs: against the size of the picture, against that of the maps, from scene to scene, and for its
// error.
#pragma once

#include "evaluation/core/blocks.hpp"
#include "evaluation/core/report.hpp"
#include "renderer/scene/scattering_stages.hpp"

#include <span>
#include <vector>

namespace gnomon::evaluation {

// Rows are those of all scenes. Measures the stage in pictures from 480 x 270 to 3840 x 2160, with maps of four sizes up to the
// finest resolution; that of half as many texels along each side is the usual one.
std::vector<block> scattering_costs(const renderer::scattering_stage& stage, std::span<const report_row> rows,
                                    int finest_resolution);

} // namespace gnomon::evaluation
