#include "view.hpp"

#include "renderer/shade/shading.hpp"

#include <glm/vec3.hpp>

#include <algorithm>

namespace gnomon::evaluation {

using namespace renderer;

material material_of(const mesh& part)
{
    if (part.opaque()) return material::opaque;
    return part.alpha ? material::smoke : material::pane;
}

namespace {

// Towards the light, in signed depth: layers of smoke that face the light have no slope, and would be in their own shadow
// wherever roundings put the map's fragments before them.
constexpr float least_bias = 0x1p-16f;

float grey(const glm::vec3& c) { return (c.r + c.g + c.b) / 3; }

// The share of light behind layer i of a pixel that the layers before it let through, for each layer and, at the end, for
// the opaque surface.
std::vector<float> weights_of_layers(const surface_layers& seen, std::vector<float>& of_opaque)
{
    std::vector<float> result(seen.layers.size());
    of_opaque.resize(seen.opaque.pixels.size());
    for (std::size_t pixel = 0; pixel < of_opaque.size(); ++pixel) {
        float left = 1;
        for (std::size_t i = seen.first[pixel + 1]; i-- > seen.first[pixel];) {
            const float alpha = grey(seen.opacities[i]);
            result[i] = left * alpha;
            left *= 1 - alpha;
        }
        of_opaque[pixel] = left;
    }
    return result;
}

std::vector<std::size_t> pixels_of_layers(const surface_layers& seen)
{
    std::vector<std::size_t> result(seen.layers.size());
    for (std::size_t pixel = 0; pixel < seen.opaque.pixels.size(); ++pixel)
        std::fill(result.begin() + seen.first[pixel], result.begin() + seen.first[pixel + 1], pixel);
    return result;
}

} // namespace

translucent_view::translucent_view(const stage& its_scenery, const camera& eye, int width, int height,
                                   int map_resolution)
    : scenery(its_scenery), seen(rasterize_surface_layers(its_scenery.world, eye, width, height))
{
    // Light reaches a layer from either side.
    for (surface& s : seen.layers)
        if (!faces_light(scenery.light, s)) s.normal = -s.normal;

    std::vector<float> of_opaque;
    const std::vector<float> of_layers = weights_of_layers(seen, of_opaque);
    const std::vector<std::size_t> pixels = pixels_of_layers(seen);
    const auto add = [&](const map_receivers& found, std::size_t i, const seen_receiver& r) {
        receivers.push_back(r), where.push_back(found.biased[i]);
        where.back().depth -= least_bias;
    };
    const map_receivers opaque = map_receivers_of(seen.opaque, scenery.light, map_resolution);
    for (std::size_t i = 0; i < opaque.size(); ++i) {
        const std::size_t pixel = opaque.pixels[i];
        add(opaque, i, {pixel, 0, seen.opaque.pixels[pixel].mesh, of_opaque[pixel]});
    }
    image<surface> layers(static_cast<int>(seen.layers.size()), 1);
    layers.pixels = seen.layers;
    const map_receivers translucent = map_receivers_of(layers, scenery.light, map_resolution);
    for (const material kind : {material::pane, material::smoke}) {
        if (kind == material::smoke) first_in_smoke = receivers.size();
        for (std::size_t i = 0; i < translucent.size(); ++i) {
            const std::size_t layer = translucent.pixels[i];
            const int mesh = seen.layers[layer].mesh;
            if (material_of(scenery.world.meshes[static_cast<std::size_t>(mesh)]) != kind) continue;
            add(translucent, i, {pixels[layer], layer, mesh, of_layers[layer]});
        }
    }
}

const surface& translucent_view::surface_of(const seen_receiver& r) const
{
    const bool is_opaque = scenery.world.meshes[static_cast<std::size_t>(r.mesh)].opaque();
    return is_opaque ? seen.opaque.pixels[r.pixel] : seen.layers[r.layer];
}

picture translucent_view::shaded(std::span<const numbers, 3> visibility) const
{
    layer_visibility all{image<glm::vec3>(seen.opaque.width, seen.opaque.height, glm::vec3(1)),
                         std::vector<glm::vec3>(seen.layers.size(), glm::vec3(1))};
    for (std::size_t i = 0; i < receivers.size(); ++i) {
        const seen_receiver& r = receivers[i];
        const glm::vec3 light(visibility[0][i], visibility[1][i], visibility[2][i]);
        const bool is_opaque = scenery.world.meshes[static_cast<std::size_t>(r.mesh)].opaque();
        (is_opaque ? all.opaque.pixels[r.pixel] : all.layers[r.layer]) = light;
    }
    return shade_layers(scenery.world, scenery.light, seen, all);
}

image<float> translucent_view::lit(const numbers& visibility) const
{
    image<float> result(seen.opaque.width, seen.opaque.height, 1);
    for (std::size_t i = 0; i < receivers.size(); ++i)
        result.pixels[receivers[i].pixel] -= receivers[i].weight * (1 - visibility[i]);
    return result;
}

} // namespace gnomon::evaluation
