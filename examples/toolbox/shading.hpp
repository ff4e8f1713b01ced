// The demo's one lighting model: Lambertian surfaces under a sun and a sky.
#pragma once

#include "camera.hpp"
#include "image.hpp"
#include "rasterizer.hpp"
#include "scene.hpp"

namespace gnomon::toolbox {

// Whether light can reach the side of the surface that the camera sees; where it cannot, no shadow map is needed.
bool faces_light(const camera& light, const surface& seen);

// Visibility attenuates the sun and not the sky.
picture shade(const scene& world, const camera& light, const image<surface>& seen, const image<float>& visibility);

} // namespace gnomon::toolbox
