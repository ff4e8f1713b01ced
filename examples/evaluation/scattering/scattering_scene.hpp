// All that a method of single scattering builds from: the shadow map of a directional light, and the camera and the air as
// the light sees them.
//
// Light axes: x is the light's right, y its up, z its direction of propagation, and the origin is the camera. Lengths are
// those of the world.
#pragma once

#include "renderer/output/image.hpp"

#include <gnomon/passes/mips.hpp>
#include <gnomon/passes/rectified_map.hpp>
#include <gnomon/storage/moments4.hpp>

#include <glm/vec3.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace gnomon::evaluation {

// A square shadow map: signed depth at each texel's centre, and the mip chain of a map of four moments that were resolved from
// four samples in each texel.
struct scattering_depths {
    renderer::image<float> centres;
    std::vector<moments4_unorm16::texel> moments;

    map_view<const float> plain() const
    {
        return {centres.pixels, std::size_t(centres.width), std::size_t(centres.height)};
    }
    mip_view<const moments4_unorm16::texel> filtered() const
    {
        return {moments, std::size_t(centres.width), std::size_t(centres.height)};
    }
};

struct scattering_scene {
    const scattering_depths& depths;
    light_map map;                    // the camera's place in the shadow map, and texels per unit of length
    std::array<glm::vec3, 4> corners; // of the view frustum's far plane in light axes, in turn from the upper left one
    float visible = 1;                // distance of the farthest visible surface, as a share of the far plane's
    float extinction = 0;             // of the air at the camera's height, per unit of length
    float falloff = 0;     // of extinction with height: exp(-falloff height) above the camera; 0 if homogeneous
    glm::vec3 up{0, 1, 0}; // of the world, in light axes
    std::size_t columns = 512, rows = 512; // of a rectified map
};

} // namespace gnomon::evaluation
