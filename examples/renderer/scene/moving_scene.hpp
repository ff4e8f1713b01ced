// A scene while the shutter is open: every corner goes along a straight line at a steady pace, and so may the light,
// which keeps its orientation, so that corners move linearly through its clip space too.
#pragma once

#include "camera.hpp"
#include "scene.hpp"
#include "stage.hpp"

#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace gnomon::renderer {

struct moving_scene {
    scene open;                                  // when the shutter opens
    std::vector<std::vector<glm::vec3>> closing; // the positions of each mesh of it when the shutter closes

    bool moves(std::size_t mesh) const { return closing[mesh] != open.meshes[mesh].positions; }
};

// The scene at time t, 0 when the shutter opens and 1 when it closes. Normals of meshes that move are left out.
scene scene_at(const moving_scene& world, float t);

// All places where the scene is at any time.
bounds bounds_of(const moving_scene& world);

struct moving_camera {
    camera open;
    glm::dvec3 motion{0}; // of its position until the shutter closes

    camera at(double t) const;
};

// What a driver needs to make a picture of motion.
struct moving_stage {
    moving_scene world;
    camera eye;
    moving_camera light;
    std::vector<point_of_interest> interests;
};

} // namespace gnomon::renderer
