// Small maps of random resolved lists, and paths over them, for tests of look-ups.
#pragma once

#include "support/effort.hpp"
#include "support/hostile.hpp"

#include <gnomon/passes/range/look_up.hpp>
#include <gnomon/passes/range/resolve.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::test {

inline constexpr std::size_t width = 12, height = 10;

/// Random resolved lists in every texel.
template <class T> struct random_map {
    std::vector<std::uint32_t> first;
    std::vector<depth_time_range<T>> ranges;

    explicit random_map(bit_source& bits, range_ids ids = range_ids::any)
        : first(range_map<T>::texels(width, height) + 1)
    {
        std::vector<std::uint32_t> texels;
        std::vector<depth_time_range<T>> all;
        for (std::size_t i = 0; i < width * height; ++i) {
            std::vector<depth_time_range<T>> list(bits.below(6));
            for (auto& r : list) {
                const double a = bits.uniform(0, 1), b = bits.uniform(0, 1);
                r = range_between(T(a), T(bits.uniform(-1, 1)), T(b), T(bits.uniform(-1, 1)), T(bits.below(5)));
            }
            std::vector<visible_span<T>> room(resolve_capacity(list.size(), ids));
            for (const auto& s : resolve_ranges<T>(list, room, ids)) {
                texels.push_back(std::uint32_t(range_map<T>::texel(width, i % width, i / width)));
                all.push_back(range_of<T>(list, s));
            }
        }
        ranges.resize(all.size());
        sort_into_lists<T>(texels, all, first, ranges);
    }
    range_map<T> map() const { return {width, height, first, ranges}; }

    /// The map with summaries, in the given memory.
    range_map<T> with_summaries(std::vector<range_summary<T>>& summaries) const
    {
        summaries.resize(first.size() - 1);
        range_map<T> result = map();
        set_summaries(result, std::span(summaries), range_ids::any);
        result.summaries = summaries;
        return result;
    }

    /// Let most lists of a single range last at all times: behind these, summaries decide.
    void fill(bit_source& bits)
    {
        for (std::size_t i = 0; i + 1 < first.size(); ++i)
            if (first[i + 1] == first[i] + 1 && bits.chance(0.9)) ranges[first[i]].t0 = 0, ranges[first[i]].t1 = 1;
    }
};

/// A path over the map, sometimes past its border.
template <class T> receiver_path<T> any_path(bit_source& bits)
{
    const double reach = bits.chance(0.3)   ? 0.7
                         : bits.chance(0.5) ? 4
                                            : 40,
                 x = bits.uniform(2, 10), y = bits.uniform(2, 8);
    const double a = bits.uniform(0, 0.4), b = bits.uniform(0.6, 1);
    return {{T(a), T(b), T(bits.uniform(-1, 1)), T(bits.uniform(-1, 1)), T(2)},
            T(x),
            T(y),
            T(1),
            T(x + bits.uniform(-reach, reach)),
            T(y + bits.uniform(-reach, reach)),
            T(1)};
}

} // namespace gnomon::test
