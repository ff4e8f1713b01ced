#include "cube_costs.hpp"

#include "renderer/raster/moving_rasterizer.hpp"
#include "renderer/scene/moving_stages.hpp"

namespace gnomon::evaluation {

cube_costs costs_of(const cube_case& at, int resolution)
{
    const renderer::moving_stage stage = renderer::random_cubes(1, at.count, longest_path * at.speed, at.half_extent);
    map_source maps(stage.world, stage.light, resolution);
    const std::size_t pairs = maps.map("exact_ranges")->pairs;
    cube_costs result{at, renderer::triangle_numbers(stage.world.open).count(), pairs, {}};
    for (const motion_method* m : registry_of<method>().all_of<motion_method>())
        if (const std::optional<map_facts> facts = m->costs(maps))
            result.maps.push_back({m, *facts, 1e6 * facts->build_ms / double(pairs)});
    return result;
}

} // namespace gnomon::evaluation
