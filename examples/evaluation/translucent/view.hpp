// A camera's picture of a stage with translucent surfaces, and its receivers: opaque surfaces, panes and layers of smoke.
#pragma once

#include "evaluation/core/receivers.hpp"
#include "renderer/raster/fragments.hpp"
#include "renderer/scene/stage.hpp"
#include "renderer/shade/layers.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace gnomon::evaluation {

enum class material { opaque, pane, smoke };

// Opaque meshes are opaque, textured translucent ones are smoke, and those of one opacity are panes.
material material_of(const renderer::mesh& part);

struct seen_receiver {
    std::size_t pixel;
    std::size_t layer; // of surface_layers, of a receiver that is not opaque
    int mesh;
    float weight; // of its light in the pixel, by its opacity and that of what is before it
};

// A number for each receiver.
using numbers = std::vector<float>;

struct translucent_view {
    translucent_view(const renderer::stage& scenery, const renderer::camera& eye, int width, int height,
                     int map_resolution);

    std::size_t size() const { return receivers.size(); }
    std::span<const map_receiver> surfaces() const { return std::span(where).first(first_in_smoke); }
    std::span<const map_receiver> smoke() const { return std::span(where).subspan(first_in_smoke); }

    // The receiver's surface, with a normal towards the light where both sides are lit.
    const renderer::surface& surface_of(const seen_receiver& r) const;

    // The picture by the visibility of red, green and blue light at each receiver.
    renderer::picture shaded(std::span<const numbers, 3> visibility) const;

    // The share of the light that each pixel would have without shadows, by a visibility at each receiver.
    renderer::image<float> lit(const numbers& visibility) const;

    const renderer::stage& scenery;
    renderer::surface_layers seen;
    std::vector<seen_receiver> receivers; // opaque surfaces, panes, smoke
    std::vector<map_receiver> where;      // of each receiver, with the renderer's depth bias
    std::size_t first_in_smoke = 0;
};

} // namespace gnomon::evaluation
