// Covered times against edge functions in extended precision.
#pragma once

#include "support/hostile.hpp"
#include "support/rounding.hpp"

#include <gnomon/motion/triangle/coverage_intervals.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace gnomon::test {

using exact = long double;

struct interval {
    double begin, end;
    template <class T> interval(T b, T e) : begin(double(b)), end(double(e)) {}
};

template <class T> std::array<interval, 4> intervals_of(const coverage_intervals<T>& x)
{
    return {interval(x.begin0, x.end0), interval(x.begin1, x.end1), interval(x.begin2, x.end2),
            interval(x.begin3, x.end3)};
}

/// The invariants of the struct, for any input.
template <class T> void require_in_order(const coverage_intervals<T>& x)
{
    const auto all = intervals_of(x);
    for (std::size_t k = 0; k < 4; ++k)
        if (T(k) < x.count) {
            REQUIRE(all[k].begin >= (k > 0 ? std::nextafter(all[k - 1].end, 2) : 0));
            REQUIRE(all[k].begin < all[k].end);
            REQUIRE(all[k].end <= 1);
        } else {
            REQUIRE(all[k].begin == coverage_none);
            REQUIRE(all[k].end == coverage_none);
        }
}

template <class T> bool covers(const coverage_intervals<T>& x, double t)
{
    const auto all = intervals_of(x);
    return std::any_of(all.begin(), all.end(), [&](interval i) { return i.begin <= t && t <= i.end; });
}

struct tally {
    std::int64_t covered = 0, decided = 0, asked = 0;
};

/// Check that a time is covered if all edge functions are positive beyond their tolerance, and not covered if one of
/// them is negative beyond it.
template <class T, class Edges>
void check_coverage(const coverage_intervals<T>& x, T facing, const std::array<exact, 3>& tolerance, Edges edges_at,
                    bit_source& bits, tally& count)
{
    const auto ask = [&](double t, tally& to) {
        const std::array<exact, 3> e = edges_at(exact(t));
        bool inside = true, outside = false;
        for (std::size_t k = 0; k < 3; ++k) {
            inside = inside && exact(facing) * e[k] > tolerance[k];
            outside = outside || exact(facing) * e[k] < -tolerance[k];
        }
        if (inside) REQUIRE(covers(x, t));
        if (outside) REQUIRE(!covers(x, t));
        to.covered += inside;
        to.decided += inside || outside;
        ++to.asked;
    };
    constexpr int times = 16;
    for (int i = 0; i < times; ++i) ask((i + bits.uniform(0, 1)) / times, count);
    // A wrong root shows beside an end, from one rounding away on.
    tally near;
    for (const interval& i : intervals_of(x))
        for (const double root : {i.begin, i.end}) {
            const double t = root + u<T> * std::exp2(bits.uniform(0, 12)) * (bits.chance(0.5) ? 1 : -1);
            if (0 <= t && t <= 1) ask(t, near);
        }
}

} // namespace gnomon::test
