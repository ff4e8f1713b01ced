#include "scattering_view.hpp"

#include "renderer/shade/shading.hpp"
#include "renderer/trace/lit_segments.hpp"
#include "renderer/trace/tracer.hpp"

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

// Surfaces are shadowed by rays, so that only the air differs between methods.
picture lit_surfaces(const scattering_stage& stage, const image<surface>& seen)
{
    return shade(stage.world, stage.light, seen, traced_visibility(tracer(stage.world), stage.light, seen));
}

std::vector<view_segment> view_segments(const scattering_stage& stage, const image<float>& distances)
{
    const double pixel = 2 * stage.eye.half_extent.x / distances.width; // at distance 1 along the axis
    std::vector<view_segment> result(distances.pixels.size());
    tbb::parallel_for(0, distances.height, [&](int y) {
        for (int x = 0; x < distances.width; ++x) {
            const view_ray ray = unit_ray(stage.eye, x, y, distances.width, distances.height);
            const double length = double(distances(x, y));
            result[std::size_t(y) * std::size_t(distances.width) + std::size_t(x)] = {
                glm::vec3(in_light_axes(stage.light, length * ray.direction)),
                float(pixel * length * glm::dot(ray.direction, stage.eye.forward)),
                {float(x) + 0.5f, float(y) + 0.5f}};
        }
    });
    return result;
}

scattering_depths depths_of(const scattering_stage& stage, int resolution)
{
    const auto samples = rasterize_depth<4>(stage.world, stage.light, resolution, resolution);
    const auto centres = rasterize_depth<1>(stage.world, stage.light, resolution, resolution);
    using format = moments4_unorm16;
    const auto size = std::size_t(resolution);
    scattering_depths result{image<float>(resolution, resolution), std::vector<format::texel>(mip_texels(size, size))};
    for (std::size_t i = 0; i < samples.pixels.size(); ++i) {
        result.centres.pixels[i] = centres.pixels[i][0];
        channel_array<format> mean{};
        for (const float z : samples.pixels[i]) {
            const auto c = std::bit_cast<channel_array<format>>(format::from_depth(z));
            for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += 0.25f * c[k];
        }
        result.moments[i] = store_channels<format>(mean);
    }
    build_mips<format>({result.moments, size, size});
    return result;
}

light_map map_of(const camera& light, const camera& eye, int resolution)
{
    const glm::dvec3 place = project(light, eye.position);
    const glm::dvec2 texels = 0.5 * resolution / light.half_extent;
    return {.x = float(place.x * resolution),
            .y = float(place.y * resolution),
            .z = float(place.z),
            .texels_x = float(texels.x),
            .texels_y = float(-texels.y), // rows run downwards
            .depths = float(2 / (light.far_distance - light.near_distance))};
}

} // namespace

glm::dvec3 in_light_axes(const camera& light, const glm::dvec3& vector)
{
    return {glm::dot(vector, light.right), glm::dot(vector, light.up), glm::dot(vector, light.forward)};
}

scattering_view::scattering_view(const scattering_stage& its_stage, const settings& how)
    : stage(its_stage),
      depths(depths_of(stage, how.map_resolution)),
      seen(rasterize_surfaces(stage.world, stage.eye, how.width * how.supersampling, how.height * how.supersampling)),
      distances(ray_lengths(stage.eye, seen)),
      where(view_segments(stage, distances)),
      surfaces_(lit_surfaces(stage, seen))
{}

scattering_scene scattering_view::scene() const
{
    const camera &eye = stage.eye, &light = stage.light;
    const auto corner = [&](double u, double v) {
        return glm::vec3(in_light_axes(light, eye.far_distance * ray_through(eye, {u, v}).direction));
    };
    double farthest = 0;
    for (const view_segment& s : where)
        farthest = std::max(farthest, glm::dot(glm::dvec3(s.end), in_light_axes(light, eye.forward)));
    constexpr double slack = 1 + 1e-4; // rounding leaves no surface outside
    const int resolution = depths.centres.width;
    return {.depths = depths,
            .map = map_of(light, eye, resolution),
            .corners = {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)},
            .visible = std::min(1.0f, float(slack * farthest / eye.far_distance)),
            .extinction = stage.air.mean_extinction() * float(std::exp(-double(stage.air.falloff) * eye.position.y)),
            .falloff = stage.air.falloff,
            .up = glm::vec3(in_light_axes(light, {0, 1, 0})),
            .columns = std::size_t(resolution),
            .rows = std::size_t(resolution)};
}

std::vector<float> scattering_view::traced(std::span<const view_segment> segments) const
{
    const camera& light = stage.light;
    std::vector<view_ray> rays;
    std::vector<double> lengths;
    for (const view_segment& s : segments) {
        const glm::dvec3 end(s.end);
        lengths.push_back(glm::length(end));
        rays.push_back(
            {stage.eye.position, (end.x * light.right + end.y * light.up + end.z * light.forward) / lengths.back()});
    }
    std::vector<float> result(segments.size());
    traced_scattering(shadow_volumes(stage.world, light), stage.air, rays, lengths, result);
    return result;
}

picture scattering_view::shown(std::span<const float> visibility) const { return with(surfaces_, visibility); }

picture scattering_view::scattered(std::span<const float> visibility) const
{
    return with(picture(seen.width, seen.height, glm::vec3(0)), visibility);
}

picture scattering_view::with(const picture& surfaces, std::span<const float> visibility) const
{
    image<float> shares(seen.width, seen.height);
    std::ranges::copy(visibility, shares.pixels.begin());
    return with_scattering(surfaces, distances, shares, stage);
}

} // namespace gnomon::evaluation
