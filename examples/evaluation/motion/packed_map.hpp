// Resolved ranges and their totals in half the memory (gnomon/passes/range/compact.hpp), which look-ups read as they are.
#pragma once

#include "range_maps.hpp"

#include <gnomon/passes/range/compact.hpp>

#include <cstdint>
#include <vector>

namespace gnomon::evaluation {

struct packed_map : map_facts {
    std::vector<std::uint16_t> begins{}, lists{}; // as in compact_spans
    std::vector<std::uint64_t> bodies{};
    std::vector<std::uint32_t> groups{};
    std::vector<range_summary<float>> totals{}; // of each texel, or none

    compact_range_map map() const
    {
        return {std::size_t(resolution), std::size_t(resolution), {begins, bodies, groups, lists}, totals};
    }
};

packed_map packed_map_of(const range_shadow_map& resolved);

} // namespace gnomon::evaluation
