#include "range_maps.hpp"

#include "evaluation/core/timing.hpp"

#include <utility>

namespace gnomon::evaluation {

using range = depth_time_range<float>;

range_shadow_map unresolved_lists(std::string label, int resolution)
{
    range_shadow_map result;
    result.label = std::move(label);
    result.kind = range_lists_kind->id;
    result.format = {"ranges_20b", "20 B ranges"};
    result.resolution = resolution;
    return result;
}

range_shadow_map with_totals(range_shadow_map resolved)
{
    resolved.label += " with totals";
    resolved.parameters["totals"] = 1;
    resolved.format = {resolved.format.id + "_totals_16b", resolved.format.label + ", 16 B totals"};
    resolved.totals.resize(texels_of(resolved.resolution));
    resolved.build_ms +=
        1e3 * least_seconds([&] { set_summaries(resolved.map(), std::span(resolved.totals), range_ids::surfaces); });
    resolved.bytes += resolved.totals.size() * sizeof resolved.totals[0];
    return resolved;
}

range_shadow_map with_ids(range_shadow_map by_triangles, std::span<const std::uint32_t> id_of_triangle)
{
    std::vector<range> renamed;
    by_triangles.build_ms += 1e3 * least_seconds([&] {
                                 renamed = by_triangles.ranges;
                                 for (range& r : renamed)
                                     if (r.id >= 0) r.id = float(id_of_triangle[std::size_t(r.id)]);
                             });
    by_triangles.label += ", ids of surfaces";
    by_triangles.parameters["surfaces"] = 1;
    by_triangles.ranges = std::move(renamed);
    return by_triangles;
}

std::size_t texels_of(int resolution)
{
    return range_map<float>::texels(std::size_t(resolution), std::size_t(resolution));
}

std::size_t list_bytes(const range_shadow_map& m)
{
    return m.first.size() * sizeof m.first[0] + m.ranges.size() * sizeof(range);
}

std::span<const range> list_of(const range_shadow_map& m, std::size_t texel)
{
    return std::span(m.ranges).subspan(m.first[texel], m.first[texel + 1] - m.first[texel]);
}

} // namespace gnomon::evaluation
