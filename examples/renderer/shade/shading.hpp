// The lighting model: Lambertian surfaces under a sun and a sky.
#pragma once

#include "renderer/output/image.hpp"
#include "renderer/raster/rasterizer.hpp"
#include "renderer/scene/camera.hpp"
#include "renderer/scene/scene.hpp"

namespace gnomon::renderer {

// Radiance of the sun at normal incidence, of the sky above, of the earth below, and of the background.
struct illumination {
    glm::vec3 sun{1.0f, 0.94f, 0.84f}, sky{0.30f, 0.35f, 0.44f}, earth{0.24f, 0.22f, 0.19f};
    glm::vec3 background{0.55f, 0.65f, 0.76f};
};
inline constexpr illumination daylight;

// True if light can reach the side of the surface that the camera sees. Elsewhere no shadow map is needed.
bool faces_light(const camera& light, const surface& seen);

// Radiance of a matt surface; sunlight is the fraction of the sun's radiance at normal incidence that reaches it.
glm::vec3 radiance(const glm::vec3& albedo, const glm::vec3& normal, const glm::vec3& sunlight);
glm::vec3 radiance(const glm::vec3& albedo, const glm::vec3& normal, float sunlight);

// The picture of the seen surfaces. Visibility attenuates the sun and not the sky.
picture shade(const scene& world, const camera& light, const image<surface>& seen, const image<float>& visibility);

} // namespace gnomon::renderer
