// A stage: a scene, a camera, a light, and the places to look at closely.
#pragma once

#include "area_light.hpp"
#include "camera.hpp"
#include "renderer/output/image.hpp"
#include "scene.hpp"

#include <glm/vec3.hpp>

#include <array>
#include <string>
#include <vector>

namespace gnomon::renderer {

// A place to magnify: its id, its name in words, and the colour of its frame.
struct point_of_interest {
    std::string id, name;
    glm::vec3 position, colour;
};

struct stage {
    scene world;
    camera eye, light;
    std::vector<point_of_interest> interests;
    glm::dvec2 light_size{0}; // of the area light around the light, 0 if the stage is made for hard shadows

    area_light area() const { return {light, light_size}; }
};

// The square of size x size pixels that the camera sees around a point.
rectangle inset_around(const point_of_interest& place, const camera& eye, int size, int width, int height);

// The scene of Peters et al. 2017, Figure 4, in metres: a bird's eye view of a direction sign, a fence with thin slats
// and a thin wall on the ground. At the points of interest, in the order of the figure (green, cyan, orange), the
// ground is shadowed by the fence only, by the fence and the wall, and by the sign, the fence and the wall.
scene fence_scene();
stage fence_stage(double aspect);

// Duckboards on the ground at noon, whose upper sides lie in front of the ground by these differences of signed depth.
// Next to a slat a filter region holds two close surfaces, and the receiver is the farther one. A point of interest for
// each.
inline constexpr std::array contact_gaps{0.01, 0.02, 0.03};
stage contact_stage(double aspect);

// A model of unit size (see model.hpp) on a ground plane, camera and area light framed by its bounds.
stage model_stage(scene model, double aspect);

} // namespace gnomon::renderer
