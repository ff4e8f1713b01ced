// The scenes of the papers on shadows of motion, and scenes with a known answer. y points up, the ground is y = 0.
#pragma once

#include "moving_scene.hpp"

#include <glm/vec3.hpp>

namespace gnomon::renderer {

// Andersson et al. 2015, Figure 11: 5 x 3 static pillars below a light that rises.
moving_stage pillars(double aspect);

// Andersson et al. 2015, Figure 12: two level quads, one above the other, that move at right angles.
moving_stage crossed_quads(double aspect);

// Andersson et al. 2015, Figure 13: two level quads, one of which moves towards the light and one away from it.
moving_stage toward_and_away(double aspect);

// After Hong & Oh: two cubes of 5808 triangles each that rise towards the light.
moving_stage cubes_to_the_light(double aspect);

// Hong & Oh 2017: cubes at random places halfway through the shutter, on paths of random directions and of random
// lengths up to `longest`, which scales the motion and changes neither places nor directions.
moving_stage random_cubes(double aspect, int count, float longest, float half_extent = 0.125f);

// Palmer 2011, Figures 4.1 to 4.3: a cube crosses a plane that turns about the x axis from -degrees to +degrees, its
// corners along straight lines. The cube is at (0, height, z) halfway.
moving_stage cube_over_plane(double aspect, float degrees, float height, float z);

// A cube crosses a plane that turns about the x axis between two angles, in degrees. The light sees its front up to
// about 117 degrees, the camera at all times.
moving_stage turning_plane(double aspect, float open, float close);

// A fan of eight level blades that turns by 90 degrees about the y axis, the corners along straight lines.
moving_stage fan(double aspect);

// A sheet of cells x cells quads that waves and drifts above the ground, as finely tessellated cloth does.
moving_stage waving_sheet(double aspect, int cells);

// After Andersson et al. 2015, Figure 10: a tilted quad that rises towards the light. It shadows nothing at any time,
// so visibility is 1 everywhere. A method that forgets when the quad was where finds shadows.
moving_stage lit_ramp(double aspect);

// Level panes of dark glass at three heights that cross one another, and an opaque cube below them. Triangles of opaque
// meshes come first: they have the same numbers where the panes are left out.
moving_stage moving_panes(double aspect);

// A quad moves along the x axis below a light so far away that the visibility is a trapezoid in x.
moving_stage trapezoid(double aspect);

// The exact fraction of time for which a point of the trapezoid's ground sees the light.
double trapezoid_visibility(const glm::dvec3& ground_point);

// A moving model of unit size (see model.hpp) on a ground plane. Camera and sun are framed by all places of the model.
moving_stage animated_model_stage(moving_scene model, double aspect);

} // namespace gnomon::renderer
