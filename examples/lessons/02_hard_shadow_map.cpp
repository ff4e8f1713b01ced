// How do triangles become a picture with filtered shadows?
//
// The light renders depths, each depth becomes a texel, the map is blurred and gets mip levels, and every pixel of the
// camera looks its shadow up once. To write a filter of your own, replace `format` and the three lines that use it.
#include "renderer/output/image.hpp"
#include "renderer/raster/rasterizer.hpp"
#include "renderer/scene/stage.hpp"
#include "renderer/shade/shading.hpp"

#include <gnomon/filters/depth_bias.h>
#include <gnomon/passes/blur.hpp>
#include <gnomon/passes/look_up.hpp>
#include <gnomon/passes/mips.hpp>
#include <gnomon/storage/formats.hpp>

#include <glm/geometric.hpp>

#include <cmath>
#include <vector>

using namespace gnomon::renderer;
using format = gnomon::moments4_unorm16; // 64 bits per texel

constexpr int width = 960, height = 540; // of the picture
constexpr int side = 1024;               // of the shadow map
constexpr double filter_radius = 5.5;    // in texels: the blur reaches 4 to either side, the look-up 1.5 further

// The bias that keeps a sloped receiver from shadowing itself: its plane rises towards the light within the filter.
double depth_bias(const camera& light, const surface& receiver, double level)
{
    const glm::dvec3 normal = receiver.normal;
    const double across = glm::length(glm::cross(light.forward, normal)); // the tilt of the normal against the light
    const double along = glm::dot(light.forward, normal);
    const double texel = 2 * light.half_extent.x / side;                                   // in the scene's units
    const double depth_per_texel = texel * 2 / (light.far_distance - light.near_distance); // at a slope of 45 degrees
    const double rise = filter_radius * std::exp2(level) * depth_per_texel; // a mip level doubles the texels
    return gnomon::depth_bias_slope_scaled(across, along, rise, 5.67);      // at most that of 80 degrees
}

int main()
{
    const stage scenery = fence_stage(double(width) / height); // a scene, a camera and a sun
    const camera& light = scenery.light;

    // 1. Render depths from the light, and make a texel of each.
    const auto depths = rasterize_depth<1>(scenery.world, light, side, side);
    std::vector<format::texel> texels(gnomon::mip_texels(side, side)); // room for all mip levels
    for (std::size_t i = 0; i < depths.pixels.size(); ++i)
        texels[i] = format::encode(format::from_depth(depths.pixels[i][0]));

    // 2. Filter the map: any linear filter will do.
    const gnomon::mip_view<format::texel> mips{texels, side, side};
    std::vector<format::texel> scratch(std::size_t(side) * side);
    gnomon::blur<format>(mips.level(0), {scratch, side, side}, mips.level(0), gnomon::gaussian_weights());
    gnomon::build_mips<format>(mips);

    // 3. Render the camera's picture, and look up the shadow of each pixel.
    const auto seen = rasterize_surfaces(scenery.world, scenery.eye, width, height);
    image<float> visibility(width, height, 1.0f);
    for (std::size_t i = 0; i < seen.pixels.size(); ++i) {
        const surface& s = seen.pixels[i];
        if (!s.valid() || !faces_light(light, s)) continue;
        const glm::dvec3 p = project(light, s.position); // texture coordinates from 0 to 1, and signed depth
        if (!within_view(p)) continue;                   // beyond the map all is lit
        const double level = mip_level(light, s.position, s.d_dx, s.d_dy, side);
        const double receiver = p.z - depth_bias(light, s, level);
        const auto filtered = gnomon::trilinear<format>(mips, float(p.x * side), float(p.y * side), float(level));
        visibility.pixels[i] = 1 - format::filtered_intensity(filtered, float(receiver));
    }
    write_png("out/lessons/02_hard_shadow_map.png", shade(scenery.world, light, seen, visibility));
}
