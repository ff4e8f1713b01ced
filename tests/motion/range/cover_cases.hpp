// Lists of ranges and of fragments, their covers, and the definition of a cover.
#pragma once

#include "motion/triangle/coverage_check.hpp"
#include "support/climber.hpp"
#include "support/effort.hpp"
#include "support/moving_triangles.hpp"
#include "support/prisms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

namespace gnomon::test {

template <class T> using list = std::vector<depth_time_range<T>>;
template <class T> using fragments = std::vector<timed_fragment<T>>;

/// Surfaces of one or two ranges each, which are disjoint in time; in half of the cases with few depths, many of them
/// equal.
template <class T> list<T> any_list(bit_source& bits)
{
    list<T> ranges;
    const bool coarse = bits.chance(0.5);
    const auto depth = [&](double centre) {
        return T(coarse ? std::round(4 * centre) / 4 : std::clamp(centre + bits.uniform(-0.2, 0.2), -1.0, 1.0));
    };
    const std::size_t surfaces = 1 + bits.below(5);
    for (std::size_t id = 0; id < surfaces; ++id) {
        const double centre = bits.uniform(-1, 1);
        std::array<double, 4> t{0, 1, 2, 2};
        if (bits.chance(0.6)) {
            for (double& x : t) x = bits.chance(0.3) ? double(bits.below(5)) / 4 : bits.uniform(0, 1);
            std::sort(t.begin(), t.end());
            if (bits.chance(0.3)) t[0] = 0, t[3] = 1; // away in between
        }
        ranges.push_back({T(t[0]), T(t[1]), depth(centre), depth(centre), T(id)});
        if (t[1] < t[2] && t[3] <= 1) ranges.push_back({T(t[2]), T(t[3]), depth(centre), depth(centre), T(id)});
    }
    return ranges;
}

template <class T> fragments<T> ends_of(const list<T>& ranges)
{
    fragments<T> all;
    for (const auto& r : ranges) all.push_back({r.t0, r.z0, r.id}), all.push_back({r.t1, r.z1, r.id});
    return all;
}

template <class T> depth_time_range<T> cover_of(const list<T>& ranges)
{
    range_cover<T> state = range_cover_begin(T(1));
    for (const auto& r : ranges) state = range_cover_add(state, r);
    return range_cover_end(state);
}

template <class T> depth_time_range<T> cover_of(const fragments<T>& all)
{
    timed_fragment<T> nearest = nearest_fragment_begin(T(1));
    for (const auto& f : all) nearest = nearest_fragment_add(nearest, f);
    fragment_cover<T> state = fragment_cover_begin(nearest);
    for (const auto& f : all) state = fragment_cover_add(state, f);
    return fragment_cover_end(state);
}

/// The id of a list's cover by definition, or -1.
template <class T> T rules_on(const list<T>& ranges)
{
    T id = -1;
    for (std::size_t k = 0; k < ranges.size() && id < 0; ++k) {
        const auto& r = ranges[k];
        if (r.t0 > 0 || r.t1 < 1 || r.z0 > 1 || r.z1 > 1) continue;
        id = r.id;
        for (std::size_t j = 0; j < ranges.size(); ++j)
            if (j != k && std::min(ranges[j].z0, ranges[j].z1) < std::max(r.z0, r.z1)) id = -1;
    }
    return id;
}

/// The linear depth of a range at a time, in extended precision.
template <class T> exact depth_at(const depth_time_range<T>& r, exact t)
{
    const exact t0 = exact(r.t0), t1 = exact(r.t1), z0 = exact(r.z0), z1 = exact(r.z1);
    return t0 == t1 ? std::min(z0, z1) : z0 + (t - t0) / (t1 - t0) * (z1 - z0);
}

/// True if a surface lasts at 257 times and at the ends of all ranges, and nothing else is in front of it.
template <class T> bool front_most(const list<T>& ranges, T id)
{
    std::vector<exact> times;
    for (int i = 0; i <= 256; ++i) times.push_back(exact(i) / 256);
    for (const auto& r : ranges) times.push_back(exact(r.t0)), times.push_back(exact(r.t1));
    return std::all_of(times.begin(), times.end(), [&](exact t) {
        exact own = 2, others = 2;
        for (const auto& r : ranges)
            if (exact(r.t0) <= t && t <= exact(r.t1)) {
                exact& z = r.id == id ? own : others;
                z = std::min(z, depth_at(r, t));
            }
        return own <= 1 && own <= others + 1e-15L;
    });
}

template <class T> bool equal(const depth_time_range<T>& a, const depth_time_range<T>& b)
{
    return a.t0 == b.t0 && a.t1 == b.t1 && a.z0 == b.z0 && a.z1 == b.z1 && a.id == b.id;
}

template <class Item> std::vector<Item> shuffled(std::vector<Item> items, bit_source& bits)
{
    for (std::size_t k = items.size(); k > 1; --k) std::swap(items[k - 1], items[bits.below(k)]);
    return items;
}

template <class T> T shadow(const list<T>& ranges, T t, T z, T id, T bias)
{
    T most = 0;
    for (const auto& r : ranges) most = std::max(most, range_intensity(r, t, z, id, bias));
    return most;
}

} // namespace gnomon::test
