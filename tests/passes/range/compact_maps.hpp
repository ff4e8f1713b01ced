// Compact lists in memory of their own, for tests.
#pragma once

#include <gnomon/passes/range/compact.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::test {

struct compact_lists {
    std::vector<std::uint16_t> begins, lists;
    std::vector<std::uint64_t> bodies;
    std::vector<std::uint32_t> groups;
    compact_spans spans;

    explicit compact_lists(const range_map<float>& map)
        : begins(compact_capacity(map)),
          lists(map.first.size() - 1),
          bodies(begins.size()),
          groups((lists.size() + compact_spans::group - 1) / compact_spans::group),
          spans(compact_ranges(map, {begins, bodies, groups, lists}))
    {}
    compact_lists(const compact_lists&) = delete;
};

/// The ranges of compact lists, one for each list, without spans of nothing.
struct unpacked_lists {
    std::vector<std::uint32_t> first{0};
    std::vector<depth_time_range<float>> ranges;

    explicit unpacked_lists(const compact_spans& spans)
    {
        for (std::size_t i = 0; i < spans.lists.size(); ++i) {
            for (const depth_time_range<float>& r : spans[i])
                if (r.t0 < r.t1) ranges.push_back(r);
            first.push_back(static_cast<std::uint32_t>(ranges.size()));
        }
    }
};

} // namespace gnomon::test
