#include "soft_stage.hpp"

#include "evaluation/core/receivers.hpp"
#include "percentage_closer_soft.hpp"
#include "renderer/shade/receivers.hpp"
#include "renderer/trace/tracer.hpp"

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace gnomon::evaluation {

soft_light soft_light_of(const renderer::area_light& light, int resolution, float widest_search)
{
    const renderer::camera& map = light.map;
    const glm::dvec2 texels_per_length = 0.5 * resolution / map.half_extent;
    const auto scale = [&](double size, double texels) {
        return float(map.perspective() ? size * texels
                                       : penumbra_texels_per_depth(std::tan(0.5 * size),
                                                                   map.far_distance - map.near_distance, texels));
    };
    return {.is_local = map.perspective(),
            .texels = {scale(light.size.x, texels_per_length.x), scale(light.size.y, texels_per_length.y)},
            .near_distance = float(map.near_distance),
            .far_distance = float(map.far_distance),
            .map_width = float(resolution),
            .map_height = float(resolution),
            .widest_search = widest_search};
}

std::vector<soft_receiver> soft_receivers_of(const renderer::image<renderer::surface>& seen,
                                             const renderer::camera& light, int resolution,
                                             std::vector<std::size_t>& pixels)
{
    map_receivers found = map_receivers_of(seen, light, resolution);
    const double steepest = renderer::steepest_slope * renderer::unit_slope(light, resolution);
    std::vector<soft_receiver> result;
    for (const map_receiver& r : found.unbiased) {
        glm::dvec2 slope = glm::dvec2(r.depth_per_u, r.depth_per_v) / double(resolution);
        const double length = glm::length(slope);
        if (!(length <= steepest))
            slope = std::isfinite(length) ? slope * (steepest / length) : glm::dvec2(steepest, 0);
        const auto size = float(resolution);
        result.push_back({r.u * size, r.v * size, r.depth, float(slope.x), float(slope.y)});
    }
    pixels = std::move(found.pixels);
    return result;
}

soft_stage::soft_stage(const renderer::stage& its_scenery, const settings& how)
    : scenery(its_scenery),
      samples(renderer::rasterize_depth<4>(scenery.world, scenery.light, how.map_resolution, how.map_resolution)),
      centres(renderer::rasterize_depth<1>(scenery.world, scenery.light, how.map_resolution, how.map_resolution)),
      seen(renderer::rasterize_surfaces(scenery.world, scenery.eye, how.width * how.supersampling,
                                        how.height * how.supersampling)),
      where(soft_receivers_of(seen, scenery.light, how.map_resolution, pixels)),
      unbiased(where)
{
    for (soft_receiver& r : unbiased) r.slope_x = r.slope_y = 0;
}

std::vector<float> filtered_visibility(const soft_stage& stage, std::span<const soft_receiver> where,
                                       float widest_search)
{
    const soft_light light = stage.light(widest_search);
    std::vector<float> result(where.size());
    tbb::parallel_for(std::size_t(0), where.size(), [&](std::size_t i) {
        const soft_receiver& r = where[i];
        const soft_place<double> place{double(r.x), double(r.y), double(r.depth), double(r.slope_x), double(r.slope_y)};
        result[i] = float(1 - percentage_closer_soft_intensity<double>(stage.samples, light, place, false));
    });
    return result;
}

std::vector<float> traced_visibility(const soft_stage& stage, int rays)
{
    const renderer::tracer tracer(stage.scenery.world);
    const renderer::image<float> traced = traced_visibility(tracer, stage.scenery.area(), stage.seen, rays);
    std::vector<float> result;
    for (const std::size_t pixel : stage.pixels) result.push_back(traced.pixels[pixel]);
    return result;
}

} // namespace gnomon::evaluation
