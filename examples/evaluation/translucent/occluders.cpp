#include "occluders.hpp"

#include "renderer/raster/rasterizer.hpp"

#include <algorithm>
#include <cstdint>
#include <span>

namespace gnomon::evaluation {

namespace {

coloured_fragments coloured(const renderer::fragment_map& map, colour of)
{
    coloured_fragments result;
    result.back_to_front.reserve(map.fragments.size());
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x) {
            int layers = 0;
            for (const renderer::fragment& f : map(x, y)) {
                const float alpha = opacity_for(of, f.opacity);
                if (!(alpha > 0)) continue;
                result.back_to_front.push_back(
                    {static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), f.depth, alpha});
                result.least_alpha = std::min(result.least_alpha, alpha);
                ++layers;
            }
            result.layers = std::max(result.layers, layers);
        }
    return result;
}

} // namespace

float opacity_for(colour of, const glm::vec3& opacity)
{
    switch (of) {
        case colour::red:
            return opacity.r;
        case colour::green:
            return opacity.g;
        case colour::blue:
            return opacity.b;
        default:
            return (opacity.r + opacity.g + opacity.b) / 3;
    }
}

translucent_occluders::translucent_occluders(const renderer::scene& world, const renderer::camera& light,
                                             int resolution)
    : opaque(renderer::rasterize_depth<4>(renderer::opaque_part(world), light, resolution, resolution)),
      translucent(renderer::rasterize_fragments(world, light, resolution, resolution))
{
    for (const colour of : {colour::grey, colour::red, colour::green, colour::blue})
        fragments_[static_cast<std::size_t>(of)] = coloured(translucent, of);
}

translucent_occluders translucent_occluders::opaque_alone() const
{
    translucent_occluders result;
    result.opaque = opaque;
    result.translucent = {.width = translucent.width,
                          .height = translucent.height,
                          .first = std::vector<std::uint32_t>(translucent.first.size()),
                          .fragments = {}};
    return result;
}

} // namespace gnomon::evaluation
