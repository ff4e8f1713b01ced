// How do shadows get softer with distance from what casts them?
//
// A receiver in a penumbra sees a part of the light. The penumbra is the wider the farther the blocker is from the
// receiver. So there are two look-ups: the mean depth of the blockers in a rectangle as wide as the widest penumbra, and
// the shadow in one as wide as the penumbra of these blockers. A summed-area table has the moments of any rectangle, at
// the same cost for all: a sum over a rectangle is the difference of four texels.
#include "renderer/raster/rasterizer.hpp"
#include "renderer/scene/soft_stages.hpp"
#include "renderer/shade/shading.hpp"

#include <gnomon/filters/depth_bias.h>
#include <gnomon/moments/bounds.h>
#include <gnomon/passes/summed_area.hpp>
#include <gnomon/soft/penumbra.h>
#include <gnomon/storage/moments4_summed.hpp>

#include <glm/trigonometric.hpp>

#include <array>
#include <vector>

using namespace gnomon::renderer;
using table = gnomon::moments4_summed;

constexpr int width = 960, height = 540, side = 1024;
constexpr float widest = 63;          // side of the largest rectangle, in texels
constexpr std::size_t most = 64 * 64; // texels that it may touch: the bits of a sum are shared among them

int main()
{
    const stage scenery = long_range_stage(double(width) / height);
    const camera& light = scenery.light;

    // 1. Render depths from the light, four samples to a texel, and sum up their moments.
    const auto depths = rasterize_depth<4>(scenery.world, light, side, side);
    std::vector<table::texel> texels(std::size_t(side) * side);
    const gnomon::map_view<table::texel> sums{texels, side, side};
    gnomon::build_summed_area<table>(gnomon::map_view<const std::array<float, 4>>{depths.pixels, side, side}, sums,
                                     most);

    // The penumbra of this light in texels, for each unit of depth between blocker and receiver.
    const double range = light.far_distance - light.near_distance;
    const glm::dvec2 tangent = glm::tan(scenery.light_size / 2.0);
    const glm::dvec2 texels_per_length = double(side) / (2.0 * light.half_extent);
    const glm::vec2 softness(gnomon::penumbra_texels_per_depth(tangent.x, range, texels_per_length.x),
                             gnomon::penumbra_texels_per_depth(tangent.y, range, texels_per_length.y));

    // 2. Render the camera's picture, and look up blockers and shadow for each pixel.
    const auto seen = rasterize_surfaces(scenery.world, scenery.eye, width, height);
    image<float> visibility(width, height, 1.0f);
    for (std::size_t i = 0; i < seen.pixels.size(); ++i) {
        const surface& s = seen.pixels[i];
        if (!s.valid() || !faces_light(light, s)) continue;
        const glm::dvec3 place = project(light, s.position); // texture coordinates from 0 to 1, and signed depth
        if (!within_view(place)) continue;                   // beyond the map all is lit
        const auto in_texels = [&](const glm::dvec3& at) { return glm::vec3(at * glm::dvec3(side, side, 1)); };
        const glm::vec3 p = in_texels(place);
        const auto penumbra = [&](float z_b) { // of blockers at depth z_b: the sides of a rectangle, in texels
            return glm::vec2(gnomon::penumbra_directional(p.z, z_b, softness.x, widest),
                             gnomon::penumbra_directional(p.z, z_b, softness.y, widest));
        };
        const glm::vec2 search = penumbra(-1); // of blockers at the near plane: no penumbra is wider
        const auto around =
            gnomon::grid_average<table>(sums, most, gnomon::summed_area_around(p.x, p.y, search.x, search.y));
        const glm::vec2 filter = penumbra(table::blocker(around, most, p.z));
        const auto filtered =
            gnomon::rectangle_average<table>(sums, most, gnomon::summed_area_around(p.x, p.y, filter.x, filter.y));
        // The bias of lesson 8: the plane of the receiver rises within the rectangle and half a texel around it.
        const glm::vec3 dx = in_texels(project(light, s.position + s.d_dx)) - p;
        const glm::vec3 dy = in_texels(project(light, s.position + s.d_dy)) - p;
        const auto plane = gnomon::depth_gradient_from_derivatives(dx.x, dx.y, dx.z, dy.x, dy.y, dy.z);
        const glm::vec2 half = 0.5f * filter + 0.5f;
        const float bias = gnomon::depth_bias_receiver_plane(plane, half.x, half.y, 0.02f);
        const float intensity = table::intensity(filtered, most, p.z - bias);
        visibility.pixels[i] = 1 - gnomon::over_darken(intensity, 0.99f); // 99% of the shadow is all of it
    }
    write_png("out/lessons/10_soft_shadow.png", shade(scenery.world, light, seen, visibility));
}
