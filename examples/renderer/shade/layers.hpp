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

// A value for each opaque surface and for each layer of surface_layers.
template <class T> struct per_surface {
    image<T> opaque;
    std::vector<T> layers;
};

using layer_visibility = per_surface<glm::vec3>; // of the light

// The radiance of each surface, that of the background where there is no opaque one. Translucent surfaces scatter the light
// that they stop, from the sun, the sky and the earth, to all sides alike.
per_surface<glm::vec3> shade_each(const scene& world, const camera& light, const surface_layers& seen,
                                  const layer_visibility& visibility);

// The picture of surfaces that send these radiances to the camera.
picture blended(const surface_layers& seen, const per_surface<glm::vec3>& radiances);

// The picture of the surfaces: shade_each(), blended.
picture shade_layers(const scene& world, const camera& light, const surface_layers& seen,
                     const layer_visibility& visibility);

} // namespace gnomon::renderer
