// Pictures with translucent surfaces, composed from back to front. Each surface has a visibility of the light of its own,
// for red, green and blue light.
#pragma once

#include "renderer/output/image.hpp"
#include "renderer/raster/fragments.hpp"
#include "renderer/scene/camera.hpp"
#include "renderer/scene/scene.hpp"

#include <glm/vec3.hpp>

#include <vector>

namespace gnomon::renderer {

// The visibility of the light at the opaque surfaces and at the layers of surface_layers.
struct layer_visibility {
    image<glm::vec3> opaque;
    std::vector<glm::vec3> layers;
};

// The picture of the surfaces. Translucent ones scatter the light that they stop, from the sun, the sky and the earth, to
// all sides alike.
picture shade_layers(const scene& world, const camera& light, const surface_layers& seen,
                     const layer_visibility& visibility);

} // namespace gnomon::renderer
