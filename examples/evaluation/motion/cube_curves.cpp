#include "cube_curves.hpp"

#include "range_maps.hpp"
#include "renderer/raster/moving_rasterizer.hpp"
#include "renderer/scene/moving_stages.hpp"

#include <array>
#include <vector>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

nlohmann::json facts_of(const map_facts& m, std::size_t ranges, std::size_t pairs)
{
    return {{"method", m.method}, {"format", m.format},
            {"bytes", m.bytes},   {"build_ms", m.build_ms},
            {"ranges", ranges},   {"ns_per_pair", 1e6 * m.build_ms / double(pairs)},
            {"covers", m.covers}, {"building_bytes", m.building_bytes}};
}

} // namespace

nlohmann::json cube_costs(const cube_case& at, int resolution)
{
    const moving_stage stage = random_cubes(1, at.count, longest_way * at.factor, at.half_extent);
    const range_shadow_map exact = exact_ranges(stage.world, stage.light, resolution);
    double pixel_time = 0;
    for (const auto& r : exact.ranges) pixel_time += double(r.t1 - r.t0);
    nlohmann::json row = {{"count", at.count},
                          {"factor", at.factor},
                          {"half_extent", at.half_extent},
                          {"triangles", triangle_numbers(stage.world.open).count()},
                          {"pairs", exact.pairs},
                          {"pixel_time", pixel_time},
                          {"maps", nlohmann::json::array()}};
    const auto add = [&](const range_shadow_map& m) {
        row["maps"].push_back(facts_of(m, m.ranges.size(), exact.pairs));
    };
    const auto add_packed = [&](const compact_shadow_map& m) {
        row["maps"].push_back(facts_of(m, m.begins.size(), exact.pairs));
    };
    add(exact);
    add(covered_ranges(exact));
    const range_shadow_map resolved = resolved_ranges(stage.world, stage.light, resolution);
    add(resolved);
    add_packed(compact_ranges(resolved));
    const range_shadow_map casters = caster_ranges(stage.world, stage.light, resolution);
    add(casters);
    add_packed(compact_ranges(casters));
    add(prism_ranges(stage.world, stage.light, resolution));
    add(covered_prism_ranges(stage.world, stage.light, resolution));
    return row;
}

std::span<const cube_case> cube_cases()
{
    constexpr float large = 0.5f; // half-extent
    static constexpr std::array<cube_case, 13> all{{{100, 1},
                                                    {200, 1},
                                                    {400, 1},
                                                    {800, 1},
                                                    {1600, 1},
                                                    {400, 2},
                                                    {400, 4},
                                                    {400, 8},
                                                    {400, 1.f / 32, large},
                                                    {400, 1.f / 8, large},
                                                    {400, 1.f / 2, large},
                                                    {400, 2, large},
                                                    {400, 8, large}}};
    return all;
}

} // namespace gnomon::evaluation
