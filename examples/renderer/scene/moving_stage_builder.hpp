// Builders of moving stages.
#pragma once

#include "moving_scene.hpp"

#include <glm/vec3.hpp>

#include <cstdint>
#include <random>
#include <vector>

namespace gnomon::renderer {

// Appends a mesh that moves from one place to another, which may deform it, or by a vector.
void add(moving_scene& world, const mesh& open, const mesh& closing);
void add(moving_scene& world, const mesh& open, const glm::vec3& motion);

// A spot light that moves along a straight line and looks at the middle of the casters. Its square picture just holds
// the casters, and hence their shadows, at all times; its planes enclose the whole world at all times. Throws
// std::invalid_argument if there is no caster, or if one is not in front of the light.
moving_camera spot_light(const moving_scene& casters, const moving_scene& world, const glm::dvec3& open,
                         const glm::dvec3& closing);

// The places of a light when the shutter opens and closes.
struct light_path {
    glm::dvec3 open, closing;
};

// A camera's place, what it looks at, and its vertical angle of view.
struct viewpoint {
    glm::dvec3 position, target;
    double degrees;
};

moving_stage staged(const moving_scene& casters, moving_scene world, const light_path& light, const viewpoint& eye,
                    double aspect, std::vector<point_of_interest> places);

// The stage on a ground that holds all casters and shadows, and a quarter of their extent more on each side. Either the
// light or the casters are static, so the shadow of a vertex moves along a straight line between its two ends.
moving_stage on_ground(const moving_scene& casters, const light_path& light, const viewpoint& eye, double aspect,
                       std::vector<point_of_interest> places);

// Random numbers that are the same everywhere, which those of std::uniform_real_distribution are not.
class uniform {
  public:
    explicit uniform(std::uint32_t seed) : bits_(seed) {}
    float operator()(float low, float high)
    {
        return low + (high - low) * (static_cast<float>(bits_() >> 8) * 0x1p-24f);
    }

  private:
    std::mt19937 bits_;
};

} // namespace gnomon::renderer
