// How do smoke and stained glass cast shadows?
//
// A translucent surface is a depth of little weight. It is blended into a moment shadow map over what lies behind it, as
// into a picture, so fragments are sorted by their depth from the light. Every blend rounds to the format, and the
// look-up is told how often. Glass stops some colours more than others: red, green and blue light have a map each. Smoke
// receives shadows, too. Its depths are spread evenly, which bounds tell loosely: it takes their middle, surfaces the
// lower bound, which darkens nothing that is lit.
#include "renderer/raster/fragments.hpp"
#include "renderer/scene/translucent_stage.hpp"
#include "renderer/shade/layers.hpp"
#include "renderer/shade/receivers.hpp"

#include <gnomon/moments/bounds.h>
#include <gnomon/passes/blend.hpp>
#include <gnomon/passes/blur.hpp>
#include <gnomon/passes/look_up.hpp>
#include <gnomon/storage/formats.hpp>

#include <cstdint>
#include <vector>

using namespace gnomon::renderer;
using format = gnomon::moments4_unorm16;
using texels = std::vector<format::texel>;

constexpr int width = 960, height = 540, side = 1024;
constexpr float least_alpha = float(gnomon::alpha_test_one_percent); // fainter fragments are not drawn
constexpr float most_layers = 32;

// The map of one colour of light: opaque surfaces, then translucent ones from back to front, then a filter.
texels map_of(const scene& world, const camera& light, int colour)
{
    const auto depths = rasterize_depth<1>(opaque_part(world), light, side, side);
    texels map(gnomon::mip_texels(side, side)), scratch(std::size_t(side) * side);
    for (std::size_t i = 0; i < depths.pixels.size(); ++i)
        map[i] = format::encode(format::from_depth(depths.pixels[i][0]));
    const auto seen = rasterize_fragments(world, light, side, side);
    std::vector<gnomon::translucent_fragment> back_to_front;
    for (std::uint32_t i = 0; i < depths.pixels.size(); ++i)
        for (const fragment& f : seen(i)) back_to_front.push_back({i % side, i / side, f.depth, f.opacity[colour]});
    const gnomon::mip_view<format::texel> mips{map, side, side};
    gnomon::blend<format>(mips.level(0), back_to_front, least_alpha);
    gnomon::blur<format>(mips.level(0), {scratch, side, side}, mips.level(0), gnomon::gaussian_weights());
    gnomon::build_mips<format>(mips);
    return map;
}

int main()
{
    const stage scenery = translucent_stage(double(width) / height);
    const camera& light = scenery.light;
    const texels maps[]{map_of(scenery.world, light, 0), map_of(scenery.world, light, 1),
                        map_of(scenery.world, light, 2)};
    const float roundings = gnomon::blend_roundings_of_layers(least_alpha, most_layers) + 2; // and two filter passes

    // The light that reaches a surface: 1 less the shadow, by the lower bound or by the middle of both.
    const auto visibility = [&](const surface& s, bool middle) {
        glm::vec3 result(1);
        const glm::dvec3 p = project(light, s.position); // texture coordinates from 0 to 1, and signed depth
        if (!s.valid() || !within_view(p)) return result;
        const double level = mip_level(light, s.position, s.d_dx, s.d_dy, side);
        const double bias = std::exp2(level) * bias_radius * plane_slope(s.position, s.normal, light, side);
        const float receiver = float(p.z - (middle ? 0 : bias));
        for (int i = 0; i < 3; ++i) {
            const auto c =
                gnomon::trilinear<format>({maps[i], side, side}, float(p.x * side), float(p.y * side), float(level));
            const auto bounds = gnomon::hamburger4_bounds(format::blended_factor(c, roundings), receiver);
            result[i] = 1 - (middle ? gnomon::bounds_intensity(bounds, 0.5f)
                                    : format::blended_intensity(c, roundings, receiver));
        }
        return result;
    };
    const surface_layers seen = rasterize_surface_layers(scenery.world, scenery.eye, width, height);
    layer_visibility light_at{{width, height, glm::vec3(1)}, {}};
    for (std::size_t i = 0; i < seen.opaque.pixels.size(); ++i)
        light_at.opaque.pixels[i] = visibility(seen.opaque.pixels[i], false);
    for (const surface& s : seen.layers) light_at.layers.push_back(visibility(s, true));
    write_png("out/lessons/09_translucent_map.png", shade_layers(scenery.world, light, seen, light_at));
}
