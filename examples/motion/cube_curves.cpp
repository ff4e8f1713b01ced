#include "cube_curves.hpp"

#include <array>
#include <vector>

#include "range_maps.hpp"
#include "toolbox/moving_rasterizer.hpp"
#include "toolbox/moving_stages.hpp"

namespace gnomon::demo {

using namespace toolbox;

namespace {

constexpr float longest = 0.5f; // way of a cube at factor 1

nlohmann::json facts_of(const range_shadow_map& m, std::size_t pairs)
{
    return {{"method", m.method},     {"format", m.format},        {"bytes", m.bytes},
            {"build_ms", m.build_ms}, {"ranges", m.ranges.size()}, {"ns_per_pair", 1e6 * m.build_ms / double(pairs)},
            {"covers", m.covers}};
}

nlohmann::json row_of(const cube_case& at, int resolution)
{
    const moving_stage stage = random_cubes(1, at.count, longest * at.factor);
    const range_shadow_map exact = exact_ranges(stage.world, stage.light, resolution);
    double pixel_time = 0;
    for (const auto& r : exact.ranges) pixel_time += double(r.t1 - r.t0);
    nlohmann::json row = {
        {"count", at.count},    {"factor", at.factor},      {"triangles", triangle_numbers(stage.world.open).count()},
        {"pairs", exact.pairs}, {"pixel_time", pixel_time}, {"maps", nlohmann::json::array()}};
    const auto add = [&](const range_shadow_map& m) { row["maps"].push_back(facts_of(m, exact.pairs)); };
    add(exact);
    add(covered_ranges(exact));
    const range_shadow_map resolved = resolved_ranges(stage.world, stage.light, resolution);
    add(resolved);
    add(packed_ranges(resolved));
    const range_shadow_map casters = caster_ranges(stage.world, stage.light, resolution);
    add(casters);
    add(packed_ranges(casters));
    add(prism_ranges(stage.world, stage.light, resolution));
    add(covered_prism_ranges(stage.world, stage.light, resolution));
    return row;
}

} // namespace

std::span<const cube_case> cube_cases()
{
    static constexpr std::array<cube_case, 8> all{
        {{100, 1}, {200, 1}, {400, 1}, {800, 1}, {1600, 1}, {400, 2}, {400, 4}, {400, 8}}};
    return all;
}

nlohmann::json cube_curves(std::span<const cube_case> cases, int resolution)
{
    nlohmann::json result = {{"resolution", resolution}, {"longest", longest}, {"rows", nlohmann::json::array()}};
    for (const cube_case& at : cases) result["rows"].push_back(row_of(at, resolution));
    return result;
}

} // namespace gnomon::demo
