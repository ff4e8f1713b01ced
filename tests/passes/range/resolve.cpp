// Resolved lists against the definition: the front-most range at many times; and lists in one array.
#include "motion/range/near_ties.hpp"
#include "support/effort.hpp"
#include "support/hostile.hpp"

#include <gnomon/passes/range/backdrop.hpp>
#include <gnomon/passes/range/map.hpp>
#include <gnomon/passes/range/resolve.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

using namespace gnomon;
using gnomon::test::bit_source;

namespace {

template <class T> using list = std::vector<depth_time_range<T>>;

/// Long and short ranges, level ones, some with common ends, some crossing; depths on a coarse grid now and then.
template <class T> list<T> any_list(bit_source& bits, std::size_t most)
{
    list<T> result(bits.below(most + 1));
    const bool coarse = bits.chance(0.3);
    const auto time = [&] { return T(coarse ? double(bits.below(9)) / 8 : bits.uniform(0, 1)); };
    const auto depth = [&] { return T(coarse ? double(bits.below(9)) / 4 - 1 : bits.uniform(-1, 1)); };
    for (std::size_t i = 0; i < result.size(); ++i) {
        const T t = bits.chance(0.2) ? T(0) : time(), z = depth();
        const T other = bits.chance(0.2) ? T(1) : bits.chance(0.2) ? T(double(t) + 0.01) : time();
        result[i] = range_between(t, z, other, bits.chance(0.2) ? z : depth(), T(i));
    }
    return result;
}

template <class T> list<T> resolved(const list<T>& ranges)
{
    std::vector<visible_span<T>> room(resolve_capacity(ranges.size(), range_ids::surfaces));
    list<T> result;
    for (const visible_span<T>& s : resolve_ranges<T>(ranges, room, range_ids::surfaces))
        result.push_back(range_of<T>(ranges, s));
    return result;
}

/// Depth in front at time t, infinity where there is nothing.
template <class T> double front_depth(const list<T>& ranges, double t)
{
    double front = std::numeric_limits<double>::infinity();
    for (const auto& r : ranges)
        if (double(r.t0) <= t && t < double(r.t1)) {
            const double passed = (t - double(r.t0)) / (double(r.t1) - double(r.t0));
            front = std::min(front, double(r.z0) * (1 - passed) + double(r.z1) * passed);
        }
    return front;
}

} // namespace

TEST_CASE_TEMPLATE("resolve_ranges: disjoint, in order, and at any time with the depth in front", T, float, double)
{
    constexpr double u = double(std::numeric_limits<T>::epsilon()) / 2;
    bit_source bits(41);
    for (std::int64_t i = 0; i < test::effort(4000); ++i) {
        const list<T> ranges = any_list<T>(bits, i % 10 == 0 ? 60 : 8), spans = resolved(ranges);
        for (std::size_t k = 0; k < spans.size(); ++k) {
            REQUIRE(spans[k].t0 < spans[k].t1);
            if (k > 0) REQUIRE(spans[k - 1].t1 <= spans[k].t0);
        }
        for (int k = 0; k < 100; ++k) {
            const double t = bits.uniform(0, 1);
            // Near an end or a crossing rounding decides which range is in front: test the neighbours, too.
            bool near_event = false;
            for (const auto& s : spans)
                near_event |= std::abs(t - double(s.t0)) < 300 * u || std::abs(t - double(s.t1)) < 300 * u;
            for (const auto& r : ranges)
                near_event |= std::abs(t - double(r.t0)) < 300 * u || std::abs(t - double(r.t1)) < 300 * u;
            if (near_event) continue;
            const double expected = front_depth(ranges, t), found = front_depth(spans, t);
            CAPTURE(t);
            if (std::isinf(expected)) REQUIRE(std::isinf(found));
            // A crossing is known within 84 u / d, d the change of distance, so depths differ there by at most 84 u; a
            // cut moves a line by 10 u.
            else REQUIRE(std::abs(expected - found) <= 128 * u);
        }
    }
}

TEST_CASE_TEMPLATE("resolve_ranges: for n ranges within a tie a climber finds the front at most n - 1 ties behind", T,
                   float, double)
{
    for (const std::size_t n : {2u, 3u, 6u}) {
        const test::summit top = test::climb_ties<T>(n, n, [](const list<T>& all) { return resolved(all); });
        CHECK(top.score <= 1.01 * double(n - 1));
        CHECK(top.score > 0.5); // a tie is used
    }
}

TEST_CASE_TEMPLATE("resolve_ranges: no order of insertion changes a bit", T, float, double)
{
    bit_source bits(42);
    for (std::int64_t i = 0; i < test::effort(2000); ++i) {
        list<T> ranges = any_list<T>(bits, 6);
        const list<T> expected = resolved(ranges);
        for (int k = 0; k < 5; ++k) {
            for (std::size_t j = ranges.size(); j > 1; --j) std::swap(ranges[j - 1], ranges[bits.below(j)]);
            const list<T> found = resolved(ranges);
            REQUIRE(found.size() == expected.size());
            for (std::size_t j = 0; j < found.size(); ++j) {
                REQUIRE(found[j].t0 == expected[j].t0);
                REQUIRE(found[j].t1 == expected[j].t1);
                REQUIRE(found[j].z0 == expected[j].z0);
                REQUIRE(found[j].z1 == expected[j].z1);
                REQUIRE(found[j].id == expected[j].id);
            }
        }
    }
}

TEST_CASE("resolve_ranges ignores ranges of no duration, with NaN or with infinite depths")
{
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    const list<float> ranges{{0, 1, 0, 0, 1},        {0.5f, 0.5f, -1, -1, 2}, {0.75f, 0.25f, -1, -1, 3},
                             {nan, 1, -1, -1, 4},    {0, nan, -1, -1, 5},     {0, 1, nan, -1, 6},
                             {0, 1, -infinity, 0, 7}};
    const list<float> spans = resolved(ranges);
    REQUIRE(spans.size() == 1);
    CHECK(spans[0].id == 1);
    CHECK(resolved(list<float>{}).empty());
}

TEST_CASE("resolve_ranges: at one depth the lower id is in front")
{
    const list<float> ranges{{0, 0.75f, 0, 0, 2}, {0.25f, 1, 0, 0, 1}}, spans = resolved(ranges);
    REQUIRE(spans.size() == 2);
    CHECK(spans[0].id == 2);
    CHECK(spans[0].t1 == 0.25f);
    CHECK(spans[1].id == 1);
}

TEST_CASE("without_backdrop removes the range behind all others at all times, and no other")
{
    bit_source bits(44);
    std::int64_t gone = 0, kept = 0;
    for (std::int64_t n = 0; n < test::effort(20'000); ++n) {
        list<float> ranges(bits.below(6));
        for (auto& r : ranges) {
            const auto real = [&](double low, double high) { return static_cast<float>(bits.uniform(low, high)); };
            r = range_between(real(0, 1), real(-1, 0.5), real(0, 1), real(-1, 0.5), float(bits.below(5)));
            if (bits.chance(0.3)) r.t0 = 0, r.t1 = 1;
        }
        const auto deepest = static_cast<float>(bits.uniform(-1, 1));
        const depth_time_range<float> ground{0, bits.chance(0.8) ? 1 : 0.9f, deepest, deepest, 7};
        ranges.insert(ranges.begin() + std::ptrdiff_t(bits.below(ranges.size() + 1)), ground);
        list<float> rest = ranges;
        const auto left = without_backdrop(std::span(rest));
        // By definition.
        const auto is_backdrop = [&](const depth_time_range<float>& b) {
            return b.t0 == 0 && b.t1 == 1 && std::ranges::all_of(ranges, [&](const depth_time_range<float>& r) {
                       return &r == &b || std::max(r.z0, r.z1) <= std::min(b.z0, b.z1);
                   });
        };
        const auto expected = std::ranges::find_if(ranges, is_backdrop);
        REQUIRE(left.size() == ranges.size() - (expected != ranges.end()));
        (expected != ranges.end() ? gone : kept) += 1;
        for (std::size_t i = 0, j = 0; i < ranges.size(); ++i) {
            if (ranges.begin() + std::ptrdiff_t(i) == expected) continue;
            REQUIRE(left[j].id == ranges[i].id);
            REQUIRE(left[j++].z0 == ranges[i].z0);
        }
    }
    CHECK(gone > 0);
    CHECK(kept > 0);
}

#if defined(__cpp_exceptions)
TEST_CASE("resolve_ranges and sort_into_lists refuse sizes that do not fit")
{
    const list<float> ranges(3, depth_time_range<float>{0, 1, 0, 0, 1});
    std::vector<visible_span<float>> room(resolve_capacity(3, range_ids::any) - 1);
    CHECK_THROWS_WITH_AS(resolve_ranges<float>(ranges, room, range_ids::any),
                         doctest::Contains("resolve: spans.size() is"), std::invalid_argument);
    std::vector<std::uint32_t> first(5, 7);
    list<float> sorted(3);
    CHECK_THROWS_WITH_AS(sort_into_lists<float>(std::vector<std::uint32_t>{0, 1}, ranges, first, sorted),
                         doctest::Contains("texels.size() is 2, but ranges.size() is 3"), std::invalid_argument);
    CHECK_THROWS_WITH_AS(sort_into_lists<float>(std::vector<std::uint32_t>{0, 4, 1}, ranges, first, sorted),
                         doctest::Contains("a texel is 4, but first.size() is 5"), std::invalid_argument);
    CHECK(first == std::vector<std::uint32_t>(5, 7));
}
#endif

TEST_CASE("sort_into_lists: every range in its texel's list, in the given order")
{
    bit_source bits(43);
    constexpr std::size_t width = 5, height = 3;
    std::vector<std::uint32_t> texels(200), first(range_map<float>::texels(width, height) + 1);
    list<float> ranges(texels.size()), sorted(texels.size());
    for (std::size_t i = 0; i < texels.size(); ++i) {
        texels[i] = std::uint32_t(range_map<float>::texel(width, bits.below(width), bits.below(height)));
        ranges[i].id = float(i);
    }
    sort_into_lists<float>(texels, ranges, first, sorted);
    const range_map<float> map{width, height, first, sorted};
    std::size_t found = 0;
    for (std::uint32_t y = 0; y < height; ++y)
        for (std::uint32_t x = 0; x < width; ++x) {
            const auto list = map(x, y);
            for (std::size_t k = 0; k < list.size(); ++k, ++found) {
                CHECK(texels[std::size_t(list[k].id)] == range_map<float>::texel(width, x, y));
                if (k > 0) CHECK(list[k - 1].id < list[k].id);
            }
        }
    CHECK(found == ranges.size());
}
