// Lists of intervals that are merged by weights: which pair is merged, the merged line, and what depends on neither.
#include "motion/range/list_cases.hpp"

#include <gnomon/comparators/interval_list.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace gnomon;
using namespace gnomon::test;

namespace {

using high = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<120>, boost::multiprecision::et_off>;

constexpr interval_weights<double> by_area{1, 0, 0, 0, 0}, evenly{0, 1, 1, 1, 1};

template <int capacity>
range_list<double, capacity> merged_list(const ranges<double>& all, const interval_weights<double>& weights,
                                         double conservative)
{
    range_list<double, capacity> list = range_list_make<double, capacity>({});
    for (const auto& r : all) list = interval_list_insert(list, r, weights, conservative);
    return list;
}

double occluded_time(const auto& list, double z)
{
    double sum = 0;
    for (int k = 0; k < 512; ++k) sum += front_at(list.ranges, (k + 0.5) / 512) < z ? 1.0 / 512 : 0;
    return sum;
}

/// A list of any capacity, whose merges keep the time that ranges cover, and keep within their depths. Conservative ones keep
/// all shadow.
template <int capacity>
void check_merges(const ranges<double>& all, const interval_weights<double>& weights, double conservative)
{
    const auto list = merged_list<capacity>(all, weights, conservative);
    double nearest = 1, farthest = -1;
    for (const auto& r : all)
        if (lasts(r)) nearest = std::min({nearest, r.z0, r.z1}), farthest = std::max({farthest, r.z0, r.z1});
    for (const auto& r : list.ranges) {
        if (!lasts(r) || conservative > 0) continue;
        RC_ASSERT(std::min(r.z0, r.z1) >= nearest - 4 * u<double>);
        RC_ASSERT(std::max(r.z0, r.z1) <= farthest + 4 * u<double>);
    }
    for (int k = 0; k < 64; ++k) {
        const double t = (k + 0.5) / 64, z = front_at(all, t);
        if (z == nowhere) continue;
        const double front = front_at(list.ranges, t);
        RC_ASSERT(front != nowhere);
        if (conservative > 0) RC_ASSERT(front <= z + slack<double>(all, t));
    }
}

} // namespace

TEST_CASE("the cost is the weighted sum of gap, differences and durations, in 120 digits")
{
    CHECK(rc::check("interval_cost", [](std::uint32_t seed) {
        bit_source bits(seed);
        const auto a = any_range<double>(bits), b = any_range<double>(bits);
        const interval_weights<double> w{0, bits.uniform(0, 2), bits.uniform(0, 2), bits.uniform(0, 2),
                                         bits.uniform(0, 2)};
        const double cost = interval_cost(a, b, w);
        if (!lasts(a) || !lasts(b)) {
            RC_ASSERT(cost == -1);
            return;
        }
        const auto& [first, second] = b.t0 < a.t0 ? std::pair(b, a) : std::pair(a, b);
        const auto slope = [](const range<double>& r) { return (high(r.z1) - high(r.z0)) / (high(r.t1) - high(r.t0)); };
        const high gap = std::max(high(second.t0) - high(first.t1), high(0));
        const high steeper = abs(slope(first) - slope(second)), size = abs(slope(first)) + abs(slope(second));
        const high lasting = high(a.t1) - high(a.t0) + high(b.t1) - high(b.t0);
        const high expected =
            w.gap * gap + w.depth * abs(high(second.z0) - high(first.z1)) + w.slope * steeper + w.duration * lasting;
        const high slack = 16 * u<double> * (expected + w.slope * size + w.gap + w.depth);
        const bool within = abs(high(cost) - expected) <= slack; // RapidCheck prints no 120 digits
        RC_ASSERT(within);
    }));
}

TEST_CASE("by area and conservatively, an interval list is a range list that drops no jointly occluded range")
{
    CHECK(rc::check("no occlusion is lost", [](std::uint32_t seed) {
        bit_source bits(seed);
        const auto all = any_ranges<double>(2 + bits.below(10), bits);
        const auto list = merged_list<4>(all, by_area, 1);
        const auto resolved = range_list_resolve(list);
        require_apart(resolved);
        for (int k = 0; k < 64; ++k) {
            const double t = (k + 0.5) / 64, z = front_at(all, t);
            if (z == nowhere) continue;
            RC_ASSERT(front_at(list.ranges, t) <= z + slack<double>(all, t));
            RC_ASSERT(front_at(resolved.ranges, t) <= z + 2 * slack<double>(all, t));
        }
    }));
}

TEST_CASE("by weights or by area, conservatively or not, lists of any capacity cover what their ranges do")
{
    CHECK(rc::check("of 1, 2, 8 and 16 ranges", [](std::uint32_t seed) {
        bit_source bits(seed);
        const auto all = any_ranges<double>(2 + bits.below(24), bits);
        for (const interval_weights<double>& weights :
             {by_area, evenly, interval_weights<double>{0, 0, 1, 0, 0}, interval_weights<double>{0, 0, 0, 0, 0}})
            for (const double conservative : {0.0, 1.0}) {
                check_merges<1>(all, weights, conservative);
                check_merges<2>(all, weights, conservative);
                check_merges<8>(all, weights, conservative);
                check_merges<16>(all, weights, conservative);
            }
    }));
}

TEST_CASE("lists that do not overflow are those of range_list, by any weights")
{
    CHECK(rc::check("the same ranges", [](std::uint32_t seed) {
        bit_source bits(seed);
        const auto all = any_ranges<double>(1 + bits.below(8), bits);
        const auto list = merged_list<8>(all, evenly, 0);
        RC_ASSERT(equal(list, list_of<8>(all)));
    }));
}

TEST_CASE("the pair of the least weight is merged into a line between its outer ends, which may lose shadow")
{
    // Three level ranges: the first two are alike in depth, the last two in time.
    const ranges<double> all{{0, 0.25, 0, 0, 1}, {0.5, 0.75, 0.125, 0.125, 2}, {0.75, 1, 0.875, 0.875, 3}};
    const auto by_depth = merged_list<2>(all, {0, 0, 1, 0, 0}, 0), by_gap = merged_list<2>(all, {0, 1, 0, 0, 0}, 0);
    const range<double> alike{0, 0.75, 0, 0.125, range_mixed}, touching{0.5, 1, 0.125, 0.875, range_mixed};
    CHECK(equal(by_depth.ranges[0], alike));
    CHECK(equal(by_depth.ranges[1], all[2]));
    CHECK(equal(by_gap.ranges[0], all[0]));
    CHECK(equal(by_gap.ranges[1], touching));
    // A receiver at 1/2 was in shadow until 3/4; behind the merged line it is in shadow for a half as long after 1/2.
    CHECK(occluded_time(by_gap, 0.5) == doctest::Approx(0.5).epsilon(0.01));
    CHECK(occluded_time(merged_list<2>(all, {0, 1, 0, 0, 0}, 1), 0.5) >= 0.75);
    const auto kept = interval_merge(range<double>{0, 1, 0, 0, 1}, range_empty(2.0));
    CHECK(equal(kept, {0, 1, 0, 0, 1}));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(interval_cost(all[0], all[1], interval_weights<double>{nan, 0, 0, 0, 0}) == double(range_far));
}
