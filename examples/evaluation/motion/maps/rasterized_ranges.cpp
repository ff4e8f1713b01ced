#include "rasterized_ranges.hpp"

#include "evaluation/core/timing.hpp"

#include <utility>

namespace gnomon::evaluation {

using namespace renderer;

rasterized_ranges::rasterized_ranges(method_facts facts, const range_options& how, range_method_facts of_ranges)
    : range_method(std::move(facts), std::move(of_ranges)), options(how)
{}

range_shadow_map rasterized_ranges::build(map_source& from, const evaluation::parameters& how) const
{
    if (is_set(how, "surfaces")) return with_ids(*from.map(id), from.surface_ids());
    range_shadow_map result = unresolved_lists(label, from.resolution);
    if (options.resolved) result.kind = resolved_lists_kind->id;
    range_rasterizer rasterize;
    const range_lists* lists = nullptr;
    result.build_ms = 1e3 * least_seconds([&] {
                          lists = &rasterize(from.world, from.light, from.resolution, from.resolution, options);
                      });
    result.first = lists->first, result.ranges = lists->ranges;
    result.pairs = lists->counts.pairs;
    result.resolved = options.resolved;
    result.bytes = list_bytes(result);
    return is_set(how, "totals") ? with_totals(std::move(result)) : result;
}

} // namespace gnomon::evaluation
