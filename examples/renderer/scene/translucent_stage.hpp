// The stage of translucent occluders, after Peters et al. 2017, Figures 5 and 6.
#pragma once

#include "stage.hpp"

namespace gnomon::renderer {

// The number of textured planes that make up the smoke. They are perpendicular to the light, in one mesh, from the one
// farthest from the light to the nearest.
inline constexpr int smoke_planes = 30;

// The largest opacity of a plane of smoke.
inline constexpr float smoke_opacity = 0.15f;

// A yard with two walls, coloured pipes at different distances from the walls, smoke, and a window of stained glass.
scene translucent_scene();

// Points of interest: light leaks on surfaces behind pipes (Figure 6a), stripes in the smoke along the silhouette of the
// blue pipe behind it (Figure 6b), the inside of the smoke, and the coloured shadow of the window.
stage translucent_stage(double aspect);

// The same from close by: smoke fills the picture (Peters et al. 2017, 2.6).
stage smoke_close_up_stage(double aspect);

} // namespace gnomon::renderer
