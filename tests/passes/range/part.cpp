// Neighbours that overlap briefly, parted: all times stay covered, and nothing else changes.
#include "support/effort.hpp"
#include "support/hostile.hpp"

#include <gnomon/passes/range/part.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace gnomon;
using gnomon::test::bit_source;

namespace {

using list = std::vector<depth_time_range<float>>;

float front(const list& ranges, float t)
{
    float nearest = 2;
    for (const auto& r : ranges)
        if (r.t0 <= t && t <= r.t1) nearest = std::min(nearest, range_depth(r, t));
    return nearest;
}

} // namespace

TEST_CASE("part_neighbours: every time keeps a range, and depths change only where neighbours overlap")
{
    bit_source bits(111);
    int parted = 0;
    for (std::int64_t n = 0; n < test::effort(5'000); ++n) {
        // A row of neighbours that overlap briefly, some others across it, in any order.
        list ranges;
        float t = 0, z = static_cast<float>(bits.uniform(-0.5, 0.5));
        while (t < 1) {
            const auto next = static_cast<float>(std::min(1.0, double(t) + bits.uniform(0.01, 0.4)));
            const float to = z + static_cast<float>(bits.uniform(-0.1, 0.1));
            ranges.push_back({std::max(t - 2e-5f, 0.f), std::min(next + 2e-5f, 1.f), z, to, float(ranges.size())});
            t = next, z = to;
        }
        for (std::size_t k = bits.below(4); k > 0; --k)
            ranges.push_back(range_between(float(bits.uniform(0, 1)), float(bits.uniform(-1, 1)),
                                           float(bits.uniform(0, 1)), float(bits.uniform(-1, 1)), 100.f));
        for (std::size_t i = ranges.size(); i > 1; --i) std::swap(ranges[i - 1], ranges[bits.below(i)]);
        list after = ranges;
        part_neighbours(std::span(after));
        for (std::size_t i = 0; i < ranges.size(); ++i) parted += after[i].t1 < ranges[i].t1;
        for (int k = 0; k < 20; ++k) {
            // Beside an end of a range now and then.
            auto asked = static_cast<float>(bits.uniform(0, 1));
            if (bits.chance(0.5)) asked = std::clamp(ranges[bits.below(ranges.size())].t1 + 1e-5f, 0.f, 1.f);
            const float before = front(ranges, asked), found = front(after, asked);
            const bool in_a_moment = std::ranges::any_of(ranges, [&](const auto& r) {
                return std::ranges::any_of(ranges, [&](const auto& next) {
                    return next.t0 <= asked && asked <= r.t1 && r.t0 < next.t0 && r.t1 < next.t1 &&
                           r.t1 - next.t0 <= neighbours_overlap<float>;
                });
            });
            REQUIRE((before == 2) == (found == 2));
            // Elsewhere lines are cut, with the errors of range_depth: twice 5 roundings of two depths.
            if (!in_a_moment) REQUIRE(std::abs(before - found) <= 20 * 0x1p-24f);
        }
    }
    CHECK(parted > test::effort(5'000));
}

TEST_CASE("part_neighbours: not if the overlap is long, or the neighbour is at another depth")
{
    const auto end_of_first = [](const depth_time_range<float>& next) {
        list two{{0, 0.5f, 0, 0, 1}, next};
        part_neighbours(std::span(two));
        return two[0].t1;
    };
    CHECK(end_of_first({0.49999f, 1, 0, 0, 2}) == 0.49999f);
    CHECK(end_of_first({0.49f, 1, 0, 0, 2}) == 0.5f);            // for too long
    CHECK(end_of_first({0.49999f, 1, 0.1f, 0.1f, 2}) == 0.5f);   // elsewhere
    CHECK(end_of_first({0.49999f, 0.499995f, 0, 0, 2}) == 0.5f); // gone before it ends
    CHECK(end_of_first({std::nanf(""), 1, 0, 0, 2}) == 0.5f);
    CHECK(end_of_first({0.49999f, 1, std::nanf(""), 0, 2}) == 0.5f);
}
