// Random ranges and lists of them, their front in extended precision, and checks of resolved lists.
#pragma once

#include "support/effort.hpp"
#include "support/hostile.hpp"

#include <gnomon/motion/range/range_list.h>
#include <gnomon/passes/range/shutters.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

namespace gnomon::test {

template <class T> using range = depth_time_range<T>;
template <class T> using ranges = std::vector<range<T>>;
template <class T> inline constexpr double u = double(std::numeric_limits<T>::epsilon()) / 2;

/// A range with times and depths on a lattice in half of the cases, so that ends and depths coincide.
template <class T> range<T> any_range(bit_source& bits)
{
    const bool lattice = bits.chance(0.5);
    const auto time = [&] { return T(lattice ? double(bits.below(9)) / 8 : bits.uniform(0, 1)); };
    const auto depth = [&] { return T(lattice ? double(bits.below(9)) / 4 - 1 : bits.uniform(-1, 1)); };
    const T z = depth();
    return range_between(time(), z, time(), bits.chance(0.3) ? z : depth(), T(bits.below(4)));
}

template <class T> ranges<T> any_ranges(std::size_t count, bit_source& bits)
{
    ranges<T> result(count);
    for (auto& r : result) r = any_range<T>(bits);
    return result;
}

template <int capacity, class T> range_list<T, capacity> list_of(const ranges<T>& all)
{
    range_list<T, capacity> list = range_list_make<T, capacity>({});
    for (const auto& r : all) list = range_list_insert(list, r);
    return list;
}

bool lasts(const auto& r) { return r.t0 < r.t1; }

template <class T> bool equal(const range<T>& a, const range<T>& b)
{
    return a.t0 == b.t0 && a.t1 == b.t1 && a.z0 == b.z0 && a.z1 == b.z1 && a.id == b.id;
}

template <class T, int capacity> bool equal(const range_list<T, capacity>& a, const range_list<T, capacity>& b)
{
    return std::equal(std::begin(a.ranges), std::end(a.ranges), std::begin(b.ranges),
                      [](const auto& x, const auto& y) { return equal(x, y); });
}

/// Depth in extended precision.
template <class T> double depth_at(const range<T>& r, double t)
{
    using wide = long double;
    const wide passed = (wide(t) - wide(r.t0)) / (wide(r.t1) - wide(r.t0));
    return double(wide(r.z0) + passed * (wide(r.z1) - wide(r.z0)));
}

inline constexpr double nowhere = 9;

/// Depth in front at time t, or nowhere.
double front_at(const auto& all, double t)
{
    double z = nowhere;
    for (const auto& r : all)
        if (double(r.t0) <= t && t < double(r.t1)) z = std::min(z, depth_at(r, t));
    return z;
}

/// Largest distance of a resolved list behind the front at time t. Its depths differ from those of the ranges by 10
/// 2^-p in range_depth and as much when clipped. It changes from one range to the next late by the error of a crossing:
/// 40 roundings of depths, and 4 of times, in which a short range covers much depth. Where rounding puts each of
/// several ranges in front of the next, the last one is that much behind each of the others.
template <class T> double slack(const auto& all, double t)
{
    double steepest = 0, others = -1;
    for (const auto& r : all) {
        if (!(double(r.t0) <= t && t <= double(r.t1) && lasts(r))) continue;
        steepest = std::max(steepest, 2 / (double(r.t1) - double(r.t0)));
        ++others;
    }
    return std::max(1.0, others) * u<T> * (64 + 8 * steepest);
}

template <class T, int capacity> ranges<T> spans_of(const range_list<T, capacity>& list)
{
    ranges<T> spans;
    for (T t = T(0); t < T(1);) {
        spans.push_back(range_list_front(list, t));
        REQUIRE(spans.back().t0 == t);
        REQUIRE(spans.back().t1 > t);
        REQUIRE(spans.back().t1 <= T(1));
        REQUIRE(std::isfinite(spans.back().z0));
        REQUIRE(std::isfinite(spans.back().z1));
        t = spans.back().t1;
    }
    REQUIRE(spans.size() <= std::size_t((capacity + 1) * (capacity + 2) / 2));
    return spans;
}

/// Check that ranges are in order of time and disjoint, empty ones first.
void require_apart(const auto& list)
{
    double end = 0;
    for (const auto& r : list.ranges) {
        if (!lasts(r)) REQUIRE(end == 0);
        if (!lasts(r)) continue;
        REQUIRE(double(r.t0) >= end);
        end = double(r.t1);
    }
    REQUIRE(end <= 1);
}

} // namespace gnomon::test
