// How does haze make shafts of light visible?
//
// Air with haze scatters light to the camera wherever light reaches it, so a pixel shows how much of its whole view ray is
// lit. As the light sees it, a view ray is a straight line from the camera, and all of it is at one angle to the light. So
// the shadow map is resampled: a row for each direction from the camera, and for depth the angle. A texel of a row shadows
// the rays that are deeper. The mean of texels up to the end of a ray holds the moments of their depths, and tells how
// much of the ray is in shadow. Light that is scattered far away counts less: the haze takes a part of it on its way.
#include "renderer/raster/rasterizer.hpp"
#include "renderer/scene/scattering_stages.hpp"
#include "renderer/shade/scattering.hpp"
#include "renderer/shade/shading.hpp"

#include <gnomon/moments/bounds.h>
#include <gnomon/moments/hamburger6.h>
#include <gnomon/passes/rectified_look_up.hpp>
#include <gnomon/passes/rectify.hpp>
#include <gnomon/passes/transmittance_prefix.hpp>
#include <gnomon/scattering/single_scattering.h>
#include <gnomon/storage/moments6.hpp>

#include <glm/geometric.hpp>

using namespace gnomon::renderer;
using format = gnomon::moments6_unorm16;

constexpr int width = 960, height = 540, side = 1024; // of the picture, and of both maps

int main()
{
    const scattering_stage scenery = room_stage(double(width) / height);
    const camera &light = scenery.light, &eye = scenery.eye;
    const auto depths = rasterize_depth<1>(scenery.world, light, side, side);

    // 1. Which directions and angles do the view rays have? The corners of the far plane tell.
    const auto from_eye = [&](const glm::dvec3& point) { // along the axes of the light
        const glm::dvec3 p = point - eye.position;
        return glm::vec3(glm::dot(p, light.right), glm::dot(p, light.up), glm::dot(p, light.forward));
    };
    const auto corner = [&](double u, double v) {
        const view_ray ray = ray_through(eye, {u, v});
        const glm::vec3 p = from_eye(ray.origin + eye.far_distance * ray.direction);
        return gnomon::rectified_corner<float>{p.x, p.y, p.z};
    };
    const gnomon::rectified_corners<float> corners{corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
    const auto frame = gnomon::rectified_frame_of(gnomon::rectified_frustum_from_corners(corners));
    std::vector<gnomon::rectified_row> rows(side);
    gnomon::rectified_rows(frame, corners, scenery.air.mean_extinction(), side, rows);

    // 2. Resample the shadow map around the camera, and average each row from there on.
    const glm::vec3 at = project(light, eye.position);
    const glm::vec2 texels = double(side) / (2.0 * light.half_extent); // to a unit of length; y of the map goes down
    const float depth_scale = float(2 / (light.far_distance - light.near_distance));
    const gnomon::light_map map{at.x * side, at.y * side, at.z, texels.x, -texels.y, depth_scale};
    std::vector<format::texel> memory(std::size_t(side) * side);
    const gnomon::map_view<format::texel> means{memory, side, side};
    gnomon::rectify<format>({{depths.pixels[0].data(), depths.pixels.size()}, side, side}, map, frame, rows, means,
                            {0, side});
    gnomon::transmittance_prefix<format>(means, rows, {0, side});

    // 3. Render the camera's picture, and look up the end of each view ray.
    const auto seen = rasterize_surfaces(scenery.world, eye, width, height);
    const auto lengths = ray_lengths(eye, seen);
    image<float> lit(width, height), lit_air(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const view_ray ray = unit_ray(eye, x, y, width, height);
            const glm::dvec3 end = ray.origin + double(lengths(x, y)) * ray.direction, p = project(light, end);
            lit(x, y) = within_view(p) && float(p.z) < depths(int(p.x * side), int(p.y * side))[0] + 0.01f;
            const glm::vec3 to = from_eye(end);
            const auto place = gnomon::rectified_from_position(to.x, to.y, to.z);
            const auto mean = gnomon::rectified_channels<format>(means, frame, rows, place);
            const auto bounds = gnomon::hamburger6_bounds(format::filtered_factor(mean),
                                                          gnomon::rectified_depth_at(frame, rows, place));
            const float toward_light = gnomon::adaptive_overestimation(std::cos(place.polar));
            lit_air(x, y) = 1 - gnomon::bounds_intensity(bounds, toward_light);
        }
    const picture surfaces = shade(scenery.world, light, seen, lit);
    write_png("out/lessons/11_single_scattering.png", with_scattering(surfaces, lengths, lit_air, scenery));
}
