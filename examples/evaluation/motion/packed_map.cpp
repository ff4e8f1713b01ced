#include "packed_map.hpp"

#include "evaluation/core/timing.hpp"

namespace gnomon::evaluation {

namespace {

const registered<map_kind> packed_kind{
    map_kind{.id = "packed_lists", .label = "lists of packed spans of time", .order = 140}};

} // namespace

packed_map packed_map_of(const range_shadow_map& resolved)
{
    packed_map result{resolved};
    const double spent = least_seconds([&] {
        const std::size_t room = compact_capacity(resolved.map()), texels = texels_of(resolved.resolution);
        result.begins.resize(room), result.bodies.resize(room);
        result.groups.resize((texels + compact_spans::group - 1) / compact_spans::group), result.lists.resize(texels);
        const compact_memory memory{result.begins, result.bodies, result.groups, result.lists};
        const std::size_t used = compact_ranges(resolved.map(), memory).begins.size();
        result.begins.resize(used), result.bodies.resize(used);
    });
    result.label += ", packed";
    result.kind = packed_kind->id;
    result.totals = resolved.totals;
    result.format = result.totals.empty() ? storage_facts{"spans_10b", "10 B spans"}
                                          : storage_facts{"spans_10b_totals_16b", "10 B spans, 16 B totals"};
    result.build_ms += 1e3 * spent;
    result.bytes = result.map().spans.bytes() + result.totals.size() * sizeof(range_summary<float>);
    return result;
}

} // namespace gnomon::evaluation
