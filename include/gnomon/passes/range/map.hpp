// A shadow map of depth-time ranges: a list for each texel, all lists one after the other in one array, in the order of
// texels, and a table of where each list begins. There are no pointers to follow, and short lists waste no memory (the
// layout that Hong & Oh 2017 name as future work, after Vasilakis & Fudos 2012).
#ifndef GNOMON_PASSES_RANGE_MAP_HPP
#define GNOMON_PASSES_RANGE_MAP_HPP

#include "../../motion/range/range_summary.h"
#include "../expects.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>

GNOMON_NAMESPACE_BEGIN

namespace detail {

/// Begin to load memory that will be read soon.
inline void prefetch([[maybe_unused]] const void* place)
{
#if defined(__GNUC__)
    __builtin_prefetch(place);
#endif
}

} // namespace detail

/// A promise about ids. A receiver ignores the ranges of its own id.
enum class range_ids {
    /// No point of an id's surface is behind another point of that surface, as seen from the light, at any time: an id
    /// is that of a triangle, a plane or the lit side of a convex part. A receiver behind its own surface is lit by
    /// that surface.
    surfaces,
    /// No promise. A receiver may be behind ranges of its own id, and in the shadow of other ranges behind these.
    any
};

/// A map of width x height texels. The texel of number i, range_map::texel(width, x, y), has the ranges first[i] to
/// first[i + 1] - 1. Texels are counted by tiles of 32 x 32, within a tile by blocks of 4 x 4, and within a block row
/// by row, so that neighbours along either axis are close in memory and a rasterizer writes tile after tile. Tiles are
/// whole: first has texels(width, height) + 1 numbers.
template <class T> struct range_map {
    std::size_t width = 0, height = 0;
    std::span<const std::uint32_t> first;
    std::span<const depth_time_range<T>> ranges;
    std::span<const range_summary<T>> summaries = {}; // of each texel's list, for static receivers; or none

    static constexpr std::size_t tile = 32, block = 4, texels_per_tile = tile * tile;
    static constexpr std::size_t tiles(std::size_t texels) { return (texels + tile - 1) / tile; }
    static constexpr std::size_t texels(std::size_t width, std::size_t height)
    {
        return tiles(width) * tiles(height) * texels_per_tile;
    }
    static constexpr std::size_t texel(std::size_t width, std::size_t x, std::size_t y)
    {
        const std::size_t in_block = y % block * block + x % block;
        const std::size_t in_tile = (y % tile / block * (tile / block) + x % tile / block) * (block * block) + in_block;
        return (y / tile * tiles(width) + x / tile) * texels_per_tile + in_tile;
    }

    std::span<const depth_time_range<T>> operator[](std::size_t i) const
    {
        return ranges.subspan(first[i], first[i + 1] - first[i]);
    }
    std::span<const depth_time_range<T>> operator()(std::size_t x, std::size_t y) const
    {
        return (*this)[texel(width, x, y)];
    }

    /// Begin to load where list i begins, then its first range, or range n of a list: steps of a look-up.
    void prefetch_begin(std::size_t i) const { detail::prefetch(&first[i]); }
    void prefetch_list(std::size_t i) const { detail::prefetch(ranges.data() + first[i]); }
    static void prefetch_range(std::span<const depth_time_range<T>> list, std::size_t n) { detail::prefetch(&list[n]); }
};

/// Check the sizes of a map's arrays.
template <class T> void check_shape(const range_map<T>& map, std::string_view pass)
{
    const std::size_t numbers = map.texels(map.width, map.height) + 1;
    GNOMON_EXPECTS(map.first.size() == numbers,
                   mismatch(pass, "map.first.size()", map.first.size(), "texels(map.width, map.height) + 1", numbers));
    GNOMON_EXPECTS(map.first.back() <= map.ranges.size(),
                   mismatch(pass, "map.first.back()", map.first.back(), "map.ranges.size()", map.ranges.size()));
    GNOMON_EXPECTS(map.summaries.empty() || map.summaries.size() + 1 == numbers,
                   mismatch(pass, "map.summaries.size() + 1", map.summaries.size() + 1, "map.first.size()", numbers));
}

/// Summary of a resolved list. Its shadowed time is 1 if and only if the ranges fill the time from 0 to 1.
template <class T> range_summary<T> summarize(std::span<const depth_time_range<T>> list, range_ids ids)
{
    range_summary<T> summary = range_summary_begin(T(-1));
    depth_time_range<T> front = range_empty(T(range_nothing));
    T filled = 0;
    bool layers = false;
    for (const depth_time_range<T>& r : list) {
        if (range_is_second_layer(front, r)) { // only a receiver whose own id is in front sees it
            summary.nearest = gnomon_min(summary.nearest, gnomon_min(r.z0, r.z1));
            layers = true;
            continue;
        }
        front = r;
        summary = range_summary_add(summary, r);
        if (r.t0 <= filled && filled < r.t1) filled = r.t1;
    }
    summary.shadowed = filled < 1 ? gnomon_min(summary.shadowed, 1 - std::numeric_limits<T>::epsilon()) : T(1);
    if (ids == range_ids::surfaces && !layers) summary.id = T(range_nothing);
    return summary;
}

/// Fill summaries with those of a map's resolved lists, one for each texel.
template <class T> void set_summaries(const range_map<T>& map, std::span<range_summary<T>> summaries, range_ids ids)
{
    check_shape(map, "range summaries");
    GNOMON_EXPECTS(summaries.size() + 1 == map.first.size(),
                   mismatch("range summaries", "summaries.size() + 1", summaries.size() + 1, "map.first.size()",
                            map.first.size()));
    for (std::size_t i = 0; i < summaries.size(); ++i) summaries[i] = summarize(map[i], ids);
}

/// Replace the number of ranges of each texel by the index at which they begin. The last number becomes the sum of all
/// counts.
inline void begins_from_counts(std::span<std::uint32_t> counts_then_sum)
{
    std::uint32_t sum = 0;
    for (std::uint32_t& x : counts_then_sum) {
        const std::uint32_t count = x;
        x = sum;
        GNOMON_EXPECTS(sum <= ~count, mismatch("range map", "ranges", sum, "room for", ~count));
        sum += count;
    }
}

/// Sort ranges, each given with its texel, into the lists of a map. Each list keeps the order of its ranges. first has
/// one number more than there are texels; sorted has as many elements as there are ranges.
template <class T>
void sort_into_lists(std::span<const std::uint32_t> texels, std::span<const depth_time_range<T>> ranges,
                     std::span<std::uint32_t> first, std::span<depth_time_range<T>> sorted)
{
    GNOMON_EXPECTS(!first.empty(), mismatch("range map", "first.size()", 0, "texels", 1));
    GNOMON_EXPECTS(texels.size() == ranges.size(),
                   mismatch("range map", "texels.size()", texels.size(), "ranges.size()", ranges.size()));
    GNOMON_EXPECTS(sorted.size() == ranges.size(),
                   mismatch("range map", "sorted.size()", sorted.size(), "ranges.size()", ranges.size()));
    for (const std::uint32_t texel : texels)
        GNOMON_EXPECTS(std::size_t(texel) + 1 < first.size(),
                       mismatch("range map", "a texel", texel, "first.size()", first.size()));
    for (std::uint32_t& x : first) x = 0;
    for (const std::uint32_t texel : texels) ++first[texel];
    begins_from_counts(first);
    for (std::size_t i = 0; i < ranges.size(); ++i) sorted[first[texels[i]]++] = ranges[i];
    for (std::size_t i = first.size() - 1; i > 0; --i) first[i] = first[i - 1];
    first[0] = 0;
}

GNOMON_NAMESPACE_END
#endif
