#include "blended_map.hpp"
#include "renderer/raster/fragments.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

using glm::vec2;
using std::floor, std::max;
#include "evaluation/vulkan/shaders/puff.h"

constexpr int puffs = 24;

// A square that faces the light. Its texture coordinates go from first to last.
void add_layer(mesh& target, const camera& light, const glm::dvec3& centre, double size, const glm::vec2& first,
               const glm::vec2& last)
{
    const glm::vec3 u = size * light.right, v = size * light.up;
    add_textured_quad(target, glm::vec3(centre) - 0.5f * (u + v), u, v, first, last);
}

mesh translucent(const char* name, float opacity)
{
    mesh result;
    result.name = name;
    result.albedo = glm::vec3(0.8f);
    result.opacity = glm::vec3(opacity);
    result.alpha = [](const glm::vec2& place) { return puff(place); };
    return result;
}

} // namespace

stage smoke_stage(double aspect)
{
    stage result = fence_stage(aspect);
    const camera& light = result.light;
    mesh smoke = translucent("smoke", 0.15f), panes = translucent("panes", 0.9f);
    for (int i = 0; i < puffs; ++i) {
        const double along = double(i) / (puffs - 1) - 0.5;
        const glm::dvec3 drift = 0.12 * std::sin(7 * along) * light.right + 0.08 * std::cos(5 * along) * light.up;
        const glm::vec2 corner(i % 2, i / 2 % 2);
        add_layer(smoke, light, glm::dvec3(0.35, 0.7, -0.9) + drift + 0.8 * along * light.forward, 1.1, corner,
                  1.f - corner);
    }
    const glm::vec2 middle(0.5f);
    add_layer(panes, light, {-0.25, 0.75, 0.9}, 0.5, middle, middle);
    add_layer(panes, light, {-0.45, 0.8, 1.1}, 0.5, middle, middle);
    result.world.meshes.push_back(std::move(smoke));
    result.world.meshes.push_back(std::move(panes));
    return result;
}

std::vector<translucent_fragment> fragments_of(const stage& scenery, int map_resolution)
{
    const fragment_map all = rasterize_fragments(scenery.world, scenery.light, map_resolution, map_resolution);
    std::vector<translucent_fragment> result;
    for (std::uint32_t y = 0; y < std::uint32_t(map_resolution); ++y)
        for (std::uint32_t x = 0; x < std::uint32_t(map_resolution); ++x)
            for (const fragment& f : all(int(x), int(y))) result.push_back({x, y, f.depth, f.opacity.r});
    return result;
}

} // namespace gnomon::evaluation
