// Joined lists against the resolved ones that they come from: the same times, behind them by no more than a tolerance.
#include "support/climber.hpp"
#include "support/effort.hpp"
#include "support/hostile.hpp"

#include <gnomon/passes/range/join.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace gnomon;
using gnomon::test::bit_source;

namespace {

template <class T> using list = std::vector<depth_time_range<T>>;

constexpr auto one_surface = [](const auto&, const auto&) { return true; };

/// Short ranges that follow one another along a line of depth, with steps and gaps now and then.
template <class T> list<T> any_course(bit_source& bits, double roughness)
{
    list<T> result;
    double t = bits.uniform(0, 0.2), z = bits.uniform(-0.8, 0.8), slope = bits.uniform(-1, 1);
    while (t < 0.95 && result.size() < 60) {
        const double next = std::min(1.0, t + bits.uniform(0.001, 0.05)), end = z + (next - t) * slope;
        result.push_back({T(t), T(next), T(z), T(end), T(bits.below(3))});
        t = next, z = std::clamp(end + roughness * bits.uniform(-1, 1), -1.0, 1.0);
        slope += 30 * roughness * bits.uniform(-1, 1);
        if (bits.chance(0.1)) t += 0.02;
        else result.back().t1 = T(t);
    }
    for (std::size_t k = 1; k < result.size(); ++k)
        if (std::abs(result[k].t0 - result[k - 1].t1) < T(1e-6)) result[k].t0 = result[k - 1].t1;
    return result;
}

template <class T> const depth_time_range<T>* at_time(const list<T>& ranges, T t)
{
    const auto found = std::ranges::find_if(ranges, [&](const auto& r) { return r.t0 <= t && t < r.t1; });
    return found == ranges.end() ? nullptr : &*found;
}

/// Distance of the joined list from the allowed depths at a time, in tolerances; infinite where coverage differs.
template <class T> double breach(const list<T>& whole, const list<T>& joined, T tolerance, T t)
{
    const auto *before = at_time(whole, t), *after = at_time(joined, t);
    if ((before == nullptr) != (after == nullptr)) return HUGE_VAL;
    if (before == nullptr) return -1;
    const double behind = double(range_depth(*after, t)) - double(range_depth(*before, t));
    return std::max(-behind, behind - double(tolerance));
}

} // namespace

TEST_CASE_TEMPLATE("join_ranges: at the same times, behind every part, by at most the tolerance", T, float, double)
{
    bit_source bits(101);
    std::size_t before = 0, after = 0;
    for (std::int64_t n = 0; n < test::effort(10'000); ++n) {
        const auto tolerance = T(std::exp2(bits.uniform(-16, -6)));
        const list<T> whole = any_course<T>(bits, std::exp2(bits.uniform(-24, -6)));
        list<T> joined = whole;
        joined.resize(join_ranges(std::span(joined), tolerance, one_surface).size());
        before += whole.size(), after += joined.size();
        // 8 roundings of the largest depth, as stated, and 5 each of the two that are compared (range_depth).
        const double rounding = 18 * double(std::numeric_limits<T>::epsilon()) / 2 * 1.1;
        for (int k = 0; k < 30; ++k) REQUIRE(breach(whole, joined, tolerance, T(bits.uniform(0, 1))) <= rounding);
    }
    CHECK(after < before / 2);
}

TEST_CASE("join_ranges: not across gaps, not of different surfaces, not without a tolerance; ids")
{
    const list<float> level{{0, 0.25f, 0, 0, 1}, {0.25f, 0.5f, 0, 0, 1}, {0.5f, 0.75f, 0, 0, 2}, {0.8f, 1, 0, 0, 2}};
    const auto joined = [&](float tolerance, const auto& same) {
        list<float> result = level;
        result.resize(join_ranges(std::span(result), tolerance, same).size());
        return result;
    };
    const list<float> all = joined(0.01f, one_surface);
    REQUIRE(all.size() == 2);
    CHECK(all[0].t1 == 0.75f);
    CHECK(all[0].id == float(range_mixed));
    CHECK(all[1].id == 2);
    CHECK(all[1].z0 == 0); // one range alone stays as it is
    const list<float> apart = joined(0.01f, [](const auto& a, const auto& b) { return a.id == b.id; });
    REQUIRE(apart.size() == 3);
    CHECK(apart[0].id == 1);
    CHECK(joined(0, one_surface).size() == 4);
    CHECK(joined(std::nanf(""), one_surface).size() == 4);
}

TEST_CASE("join_ranges: a climber finds no larger distance")
{
    constexpr std::size_t ranges = 6;
    const auto score = [](const std::vector<double>& place) {
        list<float> whole;
        float t = 0;
        for (std::size_t k = 0; k < ranges; ++k) {
            const auto at = [&](std::size_t i) { return static_cast<float>(place[3 * k + i]); };
            const float end = std::min(t + at(0) * at(0), 1.f);
            if (t < end) whole.push_back({t, end, 0.01f * at(1), 0.01f * at(2), float(k)});
            t = end;
        }
        const auto tolerance = static_cast<float>(std::exp2(-6 - 20 * place[3 * ranges]));
        list<float> joined = whole;
        joined.resize(join_ranges(std::span(joined), tolerance, one_surface).size());
        const auto asked = static_cast<float>(place[3 * ranges + 1]);
        const auto* there = at_time(joined, asked);
        if (there == nullptr || there->id >= 0) return -1e30; // nothing that was joined
        return breach(whole, joined, tolerance, asked) / (18 * 0x1p-24 * 0.02);
    };
    const test::summit top = test::climb(3 * ranges + 2, 300'000, 102, score);
    MESSAGE("of the stated error: ", top.score);
    CHECK(top.score <= 1);
    CHECK(top.score > (test::draws_few() ? -1e30 : 0)); // something was joined, and the edge of the band is reached
}
