// Pairs of ranges: their order, the part of one that is in front of the other, and their merge.
#include "list_cases.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

TEST_CASE_TEMPLATE("range_less and range_occludes: a total order and a partial order", T, float, double)
{
    bit_source bits(1);
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        const auto a = any_range<T>(bits), b = bits.chance(0.1) ? a : any_range<T>(bits), c = any_range<T>(bits);
        REQUIRE(int(range_less(a, b)) + int(range_less(b, a)) + int(equal(a, b)) == 1);
        if (range_less(a, b) && range_less(b, c)) REQUIRE(range_less(a, c));
        if (range_occludes(a, b) && range_occludes(b, c)) REQUIRE(range_occludes(a, c));
        if (range_occludes(a, b) && range_occludes(b, a)) REQUIRE(equal(a, b));
    }
}

TEST_CASE_TEMPLATE("range_visible_part, range_trim: both parts fill the common time, the nearer range in front", T,
                   float, double)
{
    bit_source bits(2);
    std::array<int, 3> cut{};
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        const auto a = any_range<T>(bits), b = any_range<T>(bits);
        const auto over = range_visible_part(a, b), under = range_visible_part(b, a), common = range_clip_to(a, b);
        if (lasts(common) && a.id != b.id) {
            REQUIRE((lasts(over) || lasts(under)));
            const T first = lasts(over) ? over.t0 : T(2), second = lasts(under) ? under.t0 : T(2);
            REQUIRE(std::min(first, second) == common.t0);
            REQUIRE(std::max(lasts(over) ? over.t1 : T(0), lasts(under) ? under.t1 : T(0)) == common.t1);
            if (lasts(over) && lasts(under)) REQUIRE((over.t1 == under.t0 || under.t1 == over.t0));
        }
        const auto left = range_trim(a, b);
        ++cut[lasts(left) ? left.t0 == a.t0 && left.t1 == a.t1 ? 0 : 1 : 2];
        for (int k = 0; lasts(a) && k < 32; ++k) {
            const double t = (k + 0.5) / 32;
            const auto during = [&](const auto& r) { return double(r.t0) <= t && t < double(r.t1); };
            if (!during(a)) continue;
            if (!during(left)) REQUIRE(during(b)); // no time is without either
            if (during(left)) REQUIRE(std::abs(depth_at(left, t) - depth_at(a, t)) <= 20 * u<T>);
            if (!during(b)) continue;
            const double behind = depth_at(a, t) - depth_at(b, t), steep = slack<T>(ranges<T>{a, b}, t);
            if (std::abs(behind) <= steep) continue;
            REQUIRE(during(over) == (behind < 0));
            REQUIRE(during(under) == (behind > 0));
            if (!during(left)) REQUIRE(behind > 0);
        }
    }
    for (const int count : cut) CHECK(count > 0);
}

// In front of both by range_depth, strictly: the margin exceeds all rounding.
TEST_CASE_TEMPLATE("range_merge lasts as long as both, in front of both, at the stated costs", T, float, double)
{
    bit_source bits(3);
    for (std::int64_t i = 0; i < effort(50'000); ++i) {
        const auto a = any_range<T>(bits), b = any_range<T>(bits);
        const auto pair = range_pair_make(a, b), other = range_pair_make(b, a);
        if (!lasts(a) || !lasts(b)) {
            REQUIRE(pair.cost == T(-1));
            REQUIRE(equal(pair.merged, lasts(a) ? a : b));
            continue;
        }
        const auto m = range_merge(a, b);
        REQUIRE(equal(m, pair.merged));
        REQUIRE(equal(m, other.merged));
        REQUIRE(m.t0 == std::min(a.t0, b.t0));
        REQUIRE(m.t1 == std::max(a.t1, b.t1));
        REQUIRE(double(m.id) == (a.id == b.id ? double(a.id) : range_mixed));
        double area = 0, shift = 0, gap = 0;
        constexpr int times = 64;
        const double step = (double(m.t1) - double(m.t0)) / times;
        for (int k = 0; k < times; ++k) {
            const T t = T(double(m.t0) + (k + 0.5) * step);
            for (const auto& r : {a, b})
                if (r.t0 <= t && t <= r.t1) REQUIRE(range_depth(m, t) <= range_depth(r, t));
            const double front = front_at(ranges<T>{a, b}, double(t));
            area += (std::min(front, 1.0) - depth_at(m, double(t))) * step;
            if (front == nowhere) gap += step;
            else shift = std::max(shift, front - depth_at(m, double(t)));
        }
        // Of 64 strips at most five contain an end or the crossing, each wrong by its width times a depth of at most 4.
        // In the others the middle of a strip is exact for a line.
        const double own = a.id == b.id ? 0 : double(range_duration(a)) + double(range_duration(b));
        REQUIRE(std::abs(double(pair.cost) - own - area) <= 5 * 4 * step + 64 * u<T>);
        REQUIRE(std::abs(double(pair.gap) - gap) <= 2 * step + 4 * u<T>);
        REQUIRE(shift <= double(pair.shift) + 32 * u<T>);
    }
}
