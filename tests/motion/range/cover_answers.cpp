// Ranges that a cover lets a list leave out, and answers of covers, against the shadow test on the whole list.
#include "cover_cases.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

TEST_CASE_TEMPLATE("leaving out the ranges that a cover occludes changes no shadow test, bit for bit", T, float, double)
{
    bit_source bits(3);
    std::int64_t covered = 0, left_out = 0, of = 0, shadowed = 0, decided = 0, asked = 0;
    for (std::int64_t i = 0; i < effort(40'000); ++i) {
        list<T> ranges = any_list<T>(bits);
        const auto cover = cover_of(ranges);
        list<T> kept;
        for (const auto& r : ranges)
            if (range_cover_occludes(cover, r) == 0) kept.push_back(r);
        if (cover.id < 0) REQUIRE(kept.size() == ranges.size());
        else REQUIRE(std::any_of(kept.begin(), kept.end(), [&](const auto& r) { return equal(r, cover); }));
        covered += cover.id >= 0;
        of += std::int64_t(ranges.size());
        left_out += std::int64_t(ranges.size() - kept.size());
        for (int j = 0; j < 20; ++j) {
            const T t = T(bits.chance(0.3) ? double(bits.below(5)) / 4 : bits.uniform(0, 1));
            const T id = T(bits.below(7)) - 1, bias = T(bits.chance(0.5) ? 0 : bits.uniform(0, 0.01));
            const auto& near_one = ranges[bits.below(ranges.size())];
            T z = T(bits.uniform(-1.1, 1.1));
            if (bits.chance(0.5)) z = range_depth(near_one, t) + bias;
            if (bits.chance(0.3)) z = std::nextafter(z, T(2));
            // The cover's own surface lies on the cover, not behind it.
            if (id == cover.id) z = std::min(z, range_depth(cover, t));
            const T whole = shadow(ranges, t, z, id, bias);
            REQUIRE(shadow(kept, t, z, id, bias) == whole);
            ++asked;
            shadowed += whole > 0;
            const auto answer = range_cover_answer(cover, t, z, id, bias);
            if (answer.decided > 0) REQUIRE(answer.intensity == whole);
            else REQUIRE(answer.intensity == 0);
            if (cover.id < 0) REQUIRE(answer.decided == 0);
            decided += answer.decided > 0;
        }
    }
    CHECK(5 * covered > effort(40'000));
    CHECK(5 * left_out > of);
    CHECK(5 * shadowed > asked);
    CHECK(10 * decided > 3 * asked);
}

// Receivers just behind a range that touches the cover's farther end, by range_depth: the list's answer is dark.
TEST_CASE_TEMPLATE("range_cover_answer: a decided answer is that of the list, bit for bit", T, float, double)
{
    const summit found = climb(10, 200'000, 1, [](const std::vector<double>& p) {
        const T far_depth = T(1.5 * p[0] - 1), t = T(p[1]), bias = T(std::max(p[2] - 0.5, 0.0));
        const T near_depth = far_depth - T(p[3] * p[3] * 0x1p-10);
        const depth_time_range<T> cover{0, 1, p[4] < 0.5 ? far_depth : near_depth, p[4] < 0.5 ? near_depth : far_depth,
                                        0};
        const auto beside = [&](double x) {
            return far_depth + (x < 0.5 ? T(0) : T(std::exp2(-30 * (2 * x - 1)) / 4));
        };
        const depth_time_range<T> r =
            range_between(T(p[5]), beside(p[6]), T(p[7]), beside(p[8]), T(1)); // not in front of it
        const T z = std::nextafter(range_depth(r, t) + bias, T(2)), id = T(p[9] < 0.5 ? 2 : 0);
        const auto answer = range_cover_answer(cover_of<T>({cover, r}), t, z, id, bias);
        const T whole = shadow<T>({cover, r}, t, z, id, bias);
        if (answer.decided > 0 && answer.intensity != whole) return 1.0;
        return whole > 0 ? -double(z - (far_depth + bias)) : -9.0; // to where it is decided lit
    });
    CHECK(found.score <= 0x1p-20);
    CHECK(found.score > -0x1p-18);
}

// Nearly level ranges, a few roundings behind a level cover, and receivers just behind them. Now and then range_depth
// puts the range in front: the margin covers that.
TEST_CASE_TEMPLATE("a range that rounding puts in front of the cover is not left out", T, float, double)
{
    bit_source bits(6);
    std::int64_t reversed = 0; // rare, so the count does not depend on effort
    for (std::int64_t i = 0; i < 1'000'000; ++i) {
        const T far_depth = T(bits.uniform(-1, 1)), begin = T(bits.uniform(0, 0.7)), end = begin + T(0.25);
        T z = far_depth;
        for (std::size_t n = bits.below(4); n > 0; --n) z = std::nextafter(z, T(2));
        const depth_time_range<T> cover{0, 1, far_depth, std::nextafter(far_depth, T(-2)), 0};
        const depth_time_range<T> r{begin, end, z, std::nextafter(z, T(2)), 1};
        const T t = begin + T(bits.uniform(0, 0.25)), behind = std::nextafter(range_depth(r, t), T(2));
        const T whole = shadow<T>({cover, r}, t, behind, T(2), T(0));
        const bool kept = range_cover_occludes(cover, r) == 0;
        REQUIRE(shadow<T>(kept ? list<T>{cover, r} : list<T>{cover}, t, behind, T(2), T(0)) == whole);
        reversed += z > far_depth && range_depth(r, t) < range_depth(cover, t);
    }
    CHECK(reversed > 0);
}
