// A scene while the shutter is open. Every vertex moves along a straight line at constant speed. So may the light and the
// camera, which keep their orientations: vertices move linearly through their clip spaces, too.
#pragma once

#include "camera.hpp"
#include "scene.hpp"
#include "stage.hpp"

#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace gnomon::renderer {

struct moving_scene {
    scene open;                                  // the scene when the shutter opens
    std::vector<std::vector<glm::vec3>> closing; // the positions of each mesh when the shutter closes

    bool moves(std::size_t mesh) const { return closing[mesh] != open.meshes[mesh].positions; }
};

// The scene at time t, from 0 when the shutter opens to 1 when it closes. Meshes that move have no normals.
scene scene_at(const moving_scene& world, float t);

// The box of all places where the scene is at any time.
bounds bounds_of(const moving_scene& world);

struct moving_camera {
    camera open;
    glm::dvec3 motion{0}; // translation until the shutter closes

    camera at(double t) const;
};

// A stage of motion.
struct moving_stage {
    moving_scene world;
    moving_camera eye, light;
    std::vector<point_of_interest> interests;
};

} // namespace gnomon::renderer
