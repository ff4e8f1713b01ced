// The stages of soft shadows, after Peters et al. 2017, Figures 8 to 11. Each has an area light.
#pragma once

#include "stage.hpp"

namespace gnomon::renderer {

// Figure 8: two models over a plane, one of a thick knot, one a chair of thin parts.
stage models_stage(double aspect);

// The same under a lamp, a local light.
stage lamp_stage(double aspect);

// Figure 9: signs and cables high above the ground cast shadows over a long range, a bench casts them over a short one.
stage long_range_stage(double aspect);

// Figure 10: the hardness of a pillar's contact shadow should be equal on both sides of the pillar. On one side a search
// region holds the edge of a distant wall of bricks, too.
stage pillar_stage(double aspect);

// Figure 11: a column on the ground, which is lit at an angle of incidence of 80 degrees.
stage grazing_stage(double aspect);

} // namespace gnomon::renderer
