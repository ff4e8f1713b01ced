// Maps of compact lists (storage/compact_spans.hpp): a map of resolved lists, rounded to 16 bits of time and 20 bits of
// depth, in half the memory. Look-ups (look_up.hpp) read such a map directly.
//
//     compact_memory memory{begins, bodies, groups, lists};   // compact_capacity(map) spans
//     compact_range_map small{map.width, map.height, compact_ranges(map, memory), summaries};
//
// Rounding is conservative. At every time, a compact list shadows all that its resolved list shadows, with one
// exception: where one surface passes in front of another, either may have the other's id for up to 2^-16 of the
// shutter, and a receiver ignores its own id. A span begins at most 2^-16 before its range and ends at most 2^-16 after
// it. Depth is nearer by at most 2^-19, plus the change of the range's depth within 2^-16 of the shutter; for ranges
// shorter than 4 2^-16, plus the change of all depths within 6 2^-16.
#ifndef GNOMON_PASSES_RANGE_COMPACT_HPP
#define GNOMON_PASSES_RANGE_COMPACT_HPP

#include "../../storage/compact_spans.hpp"
#include "map.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

GNOMON_NAMESPACE_BEGIN

/// A map of width x height texels with compact lists, one for each texel, in the order of range_map::texel.
struct compact_range_map {
    std::size_t width = 0, height = 0;
    compact_spans spans;
    std::span<const range_summary<float>> summaries = {}; // of each texel's list, for static receivers; or none

    static constexpr std::size_t texel(std::size_t width, std::size_t x, std::size_t y)
    {
        return range_map<float>::texel(width, x, y);
    }
    compact_list operator[](std::size_t i) const { return spans[i]; }
    compact_list operator()(std::size_t x, std::size_t y) const { return spans[texel(width, x, y)]; }

    /// Begin to load, as of range_map.
    void prefetch_begin(std::size_t i) const { detail::prefetch(&spans.lists[i]); }
    void prefetch_list(std::size_t i) const { prefetch_range(spans[i], 0); }
    static void prefetch_range(const compact_list& list, std::size_t n)
    {
        detail::prefetch(list.begin_of(n));
        detail::prefetch(list.body_of(n));
    }
};

/// Check the sizes of a map's arrays.
inline void check_shape(const compact_range_map& map, std::string_view pass)
{
    const compact_spans& s = map.spans;
    const std::size_t texels = range_map<float>::texels(map.width, map.height);
    const std::size_t groups = (texels + s.group - 1) / s.group;
    GNOMON_EXPECTS(s.lists.size() == texels,
                   mismatch(pass, "map.spans.lists.size()", s.lists.size(), "texels(map.width, map.height)", texels));
    GNOMON_EXPECTS(s.groups.size() == groups,
                   mismatch(pass, "map.spans.groups.size()", s.groups.size(), "texels / 64", groups));
    GNOMON_EXPECTS(s.bodies.size() == s.begins.size(), mismatch(pass, "map.spans.bodies.size()", s.bodies.size(),
                                                                "map.spans.begins.size()", s.begins.size()));
    GNOMON_EXPECTS(
        texels == 0 || s.begin(texels - 1) <= s.begins.size(),
        mismatch(pass, "begin of the last list", s.begin(texels - 1), "map.spans.begins.size()", s.begins.size()));
    GNOMON_EXPECTS(map.summaries.empty() || map.summaries.size() == texels,
                   mismatch(pass, "map.summaries.size()", map.summaries.size(), "map.spans.lists.size()", texels));
}

/// The caller's memory for compact lists: begins and bodies for compact_capacity spans, groups for one number for each
/// 64 texels, lists for one number for each texel.
struct compact_memory {
    std::span<std::uint16_t> begins;
    std::span<std::uint64_t> bodies;
    std::span<std::uint32_t> groups;
    std::span<std::uint16_t> lists;
};

namespace detail {

/// Steps of time from begin to end, and the number of the range that they show; none unless begin < end.
struct compact_stretch {
    double begin = 0, end = 0;
    std::size_t owner = 0;

    bool some() const { return begin < end; }
};

/// Writes one list, span by span, to receive(begin, z0, z1, id): at most 2 n + 1 spans of n ranges.
template <class Emit> class compact_writer {
  public:
    using range = depth_time_range<float>;

    compact_writer(std::span<const range> list, const Emit& receive) : list_(list), receive_(receive) {}

    void write_spans()
    {
        for (std::size_t i = 0; i < list_.size(); ++i) {
            const double t0 = double(list_[i].t0) * compact_times, t1 = double(list_[i].t1) * compact_times;
            if (!(t0 < t1)) continue;
            const double inner0 = std::ceil(t0), inner1 = std::floor(t1);
            add({std::floor(t0), inner0, i});
            add({inner0, inner1, i});
            if (inner0 <= inner1) add({inner1, std::ceil(t1), i});
        }
        join(step_);
        finish(joined_);
        if (0 < reached_ && reached_ < compact_times) receive_(reached_, 1.0, 1.0, compact_nothing);
    }

  private:
    /// Add a stretch in order. A step of time that several ranges share goes to the one that is nearest in it.
    void add(const compact_stretch& s)
    {
        if (!s.some()) return;
        if (step_.some() && s.begin < step_.end) {
            const auto nearest_of = [&](std::size_t i) { return nearest(list_.subspan(i, 1), s); };
            if (nearest_of(s.owner) < nearest_of(step_.owner)) step_ = s;
            return;
        }
        join(step_);
        step_ = s;
    }

    void join(const compact_stretch& s)
    {
        if (!s.some()) return;
        if (joined_.some() && joined_.owner == s.owner && joined_.end == s.begin) {
            joined_.end = s.end;
            return;
        }
        finish(joined_);
        joined_ = s;
    }

    /// Emit a stretch with the owner's line, moved towards the light until it is in front of all ranges in that time.
    /// The line of a brief range would be far off beyond its ends, and a line beyond the near plane may not be moved:
    /// both become level.
    void finish(const compact_stretch& s)
    {
        if (!s.some()) return;
        if (reached_ < s.begin) receive_(reached_, 1.0, 1.0, compact_nothing);
        const range& own = list_[s.owner];
        double ahead = 0;
        for_each_end(list_, s,
                     [&](const range& r, double t) { ahead = (std::max)(ahead, depth(own, t) - depth(r, t)); });
        double z0 = depth(own, s.begin / compact_times) - ahead, z1 = depth(own, s.end / compact_times) - ahead;
        const bool brief = double(own.t1) - double(own.t0) < 4.0 / compact_times;
        if (brief || (std::min)(z0, z1) < -1) z0 = z1 = nearest(list_, s);
        const bool mixed = own.id == float(range_mixed);
        receive_(s.begin, z0, z1, mixed ? compact_mixed : static_cast<std::uint32_t>(own.id));
        reached_ = s.end;
    }

    /// Depth on the line of a range, also beyond its ends.
    static double depth(const range& r, double t)
    {
        const double passed = (t - double(r.t0)) / (double(r.t1) - double(r.t0));
        return double(r.z0) + (double(r.z1) - double(r.z0)) * passed;
    }

    /// Call visit(range, time) for both ends of the parts of ranges within a stretch.
    template <class Visit>
    static void for_each_end(std::span<const range> list, const compact_stretch& s, const Visit& visit)
    {
        const double open = s.begin / compact_times, close = s.end / compact_times;
        for (const range& r : list) {
            if (!(r.t0 < r.t1) || double(r.t1) <= open || close <= double(r.t0)) continue;
            visit(r, (std::max)(double(r.t0), open));
            visit(r, (std::min)(double(r.t1), close));
        }
    }

    static double nearest(std::span<const range> list, const compact_stretch& s)
    {
        double z = 1;
        for_each_end(list, s, [&](const range& r, double t) { z = (std::min)(z, depth(r, t)); });
        return z;
    }

    std::span<const range> list_;
    const Emit& receive_;
    compact_stretch step_, joined_; // the last stretch, which may still change, and those before it of one owner
    double reached_ = 0;
};

template <class Emit> void write_compact(std::span<const depth_time_range<float>> list, const Emit& receive)
{
    compact_writer<Emit>(list, receive).write_spans();
}

/// Check that a list is resolved, without second layers: times in [0, 1], in order and disjoint, finite depths, ids
/// that 24 bits hold. Empty ranges pass.
inline void check_compact_list(std::span<const depth_time_range<float>> list, std::size_t number)
{
    [[maybe_unused]] const auto wrong = [&](std::size_t k, std::string_view what) {
        std::string text = "gnomon: compact ranges: list ";
        return text.append(std::to_string(number))
            .append(", range ")
            .append(std::to_string(k))
            .append(": ")
            .append(what);
    };
    float reached = 0;
    for (std::size_t k = 0; k < list.size(); ++k) {
        const depth_time_range<float>& r = list[k];
        if (!(r.t0 < r.t1)) continue;
        GNOMON_EXPECTS(reached <= r.t0 && r.t1 <= 1, wrong(k, "its times are not in [0, 1], in order and disjoint"));
        GNOMON_EXPECTS((std::isfinite)(r.z0) && (std::isfinite)(r.z1), wrong(k, "its depths are not finite"));
        const bool whole = r.id >= 0 && r.id < float(compact_mixed) && r.id == std::floor(r.id);
        GNOMON_EXPECTS(whole || r.id == float(range_mixed),
                       wrong(k, "its id is " + std::to_string(r.id) + ", whole numbers below 16777214 are possible"));
        reached = r.t1;
    }
}

} // namespace detail

/// Number of spans that compact_ranges needs room for: 2 n + 1 for each list of n ranges.
inline std::size_t compact_capacity(const range_map<float>& map)
{
    check_shape(map, "compact ranges");
    std::size_t sum = 0;
    for (std::size_t i = 0; i + 1 < map.first.size(); ++i)
        if (const std::size_t n = map.first[i + 1] - map.first[i]) sum += 2 * n + 1;
    return sum;
}

/// Write the lists of a map into the caller's memory, and return the part of that which they need. The lists are
/// resolved, without second layers (range_ids::surfaces). Depths below -1 count as -1, depths above 1 as 1.
inline compact_spans compact_ranges(const range_map<float>& map, const compact_memory& memory)
{
    constexpr std::string_view pass = "compact ranges";
    const std::size_t capacity = compact_capacity(map), texels = map.first.size() - 1;
    const std::size_t groups = (texels + compact_spans::group - 1) / compact_spans::group;
    const auto expect_room = [&](std::string_view name, std::size_t size, std::string_view what, std::size_t needed) {
        GNOMON_EXPECTS(size >= needed, mismatch(pass, name, size, what, needed));
    };
    GNOMON_EXPECTS(capacity <= 0xffffffff,
                   mismatch(pass, "compact_capacity(map)", capacity, "the largest", 0xffffffff));
    expect_room("memory.begins.size()", memory.begins.size(), "compact_capacity(map)", capacity);
    expect_room("memory.bodies.size()", memory.bodies.size(), "compact_capacity(map)", capacity);
    expect_room("memory.groups.size()", memory.groups.size(), "texels / 64", groups);
    expect_room("memory.lists.size()", memory.lists.size(), "texels", texels);
    for (std::size_t begin = 0; begin < texels; begin += compact_spans::group) {
        const std::size_t end = (std::min)(begin + compact_spans::group, texels);
        for (std::size_t i = begin; i < end; ++i) detail::check_compact_list(map[i], i);
        const std::size_t ranges = map.first[end - 1] - map.first[begin]; // of all lists but the last of the group
        if (2 * ranges + compact_spans::group <= 0xffff) continue;
        std::size_t spans = 0;
        for (std::size_t i = begin; i + 1 < end; ++i)
            detail::write_compact(map[i], [&](double, double, double, std::uint32_t) { ++spans; });
        GNOMON_EXPECTS(spans <= 0xffff, mismatch(pass, "spans of 63 lists", spans, "the largest number", 0xffff));
    }

    std::size_t count = 0, group = 0;
    for (std::size_t i = 0; i < texels; ++i) {
        if (i % compact_spans::group == 0) {
            memory.groups[i / compact_spans::group] = static_cast<std::uint32_t>(count);
            group = count;
        }
        memory.lists[i] = static_cast<std::uint16_t>(count - group);
        detail::write_compact(map[i], [&](double begin, double z0, double z1, std::uint32_t id) {
            memory.begins[count] = static_cast<std::uint16_t>(begin);
            memory.bodies[count++] = compact_body(z0, z1, id);
        });
    }
    return {memory.begins.first(count), memory.bodies.first(count), memory.groups.first(groups),
            memory.lists.first(texels)};
}

GNOMON_NAMESPACE_END
#endif
