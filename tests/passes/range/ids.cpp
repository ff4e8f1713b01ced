// Receivers of every id and depth: resolved lists, their summaries and lists resolved in two steps give them the answer of
// all ranges, the time in which any range of another id is in front of them.
#include "motion/receiver/receiver_cases.hpp"
#include "support/climber.hpp"

#include <gnomon/passes/range/look_up.hpp>
#include <gnomon/passes/range/resolve.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <utility>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

template <class T> using list = std::vector<depth_time_range<T>>;

template <class T> list<T> resolved(const list<T>& ranges, range_ids ids)
{
    std::vector<visible_span<T>> room(resolve_capacity(ranges.size(), ids));
    list<T> result;
    for (const auto& s : resolve_ranges<T>(ranges, room, ids)) result.push_back(range_of<T>(ranges, s));
    return result;
}

/// A list of which the first half is resolved by itself, then together with the rest.
template <class T> list<T> resolved_in_steps(const list<T>& ranges, range_ids ids)
{
    const auto half = ranges.begin() + std::ptrdiff_t(ranges.size() / 2);
    list<T> rest = resolved(list<T>(ranges.begin(), half), ids);
    rest.insert(rest.end(), half, ranges.end());
    return resolved(rest, ids);
}

/// Share of the time of its path in which a receiver has a range of another id in front of it by more than
/// -slack.
template <class T> wide hidden_share(const list<T>& ranges, const depth_time_range<T>& path, wide slack)
{
    std::vector<std::pair<wide, wide>> hidden;
    for (const auto& r : ranges) {
        const wide early = std::max(wide(r.t0), wide(path.t0)), late = std::min(wide(r.t1), wide(path.t1));
        if (r.id == path.id || !(early < late)) continue;
        const wide a = exact_depth(path, early) - exact_depth(r, early) + slack;
        const wide b = exact_depth(path, late) - exact_depth(r, late) + slack;
        const wide meeting = a == b ? early : early + std::clamp(a / (a - b), 0.0L, 1.0L) * (late - early);
        if (a > 0 || b > 0) hidden.push_back({a > 0 ? early : meeting, b > 0 ? late : meeting});
    }
    std::ranges::sort(hidden);
    wide sum = 0, reached = 0;
    for (const auto& [from, to] : hidden)
        if (to > reached) sum += to - std::max(from, reached), reached = to;
    return sum / (wide(path.t1) - wide(path.t0));
}

/// A map of one texel, and its look-ups.
template <class T> struct one_texel {
    list<T> ranges;
    std::vector<std::uint32_t> first;
    std::vector<range_summary<T>> summaries;

    one_texel(const list<T>& resolved, range_ids ids)
        : ranges(resolved),
          first(range_map<T>::texels(1, 1) + 1, std::uint32_t(ranges.size())),
          summaries(first.size() - 1)
    {
        first[0] = 0;
        set_summaries(map(), std::span(summaries), ids);
    }
    range_map<T> map() const { return {1, 1, first, ranges}; }
    range_map<T> with_summaries() const { return {1, 1, first, ranges, summaries}; }

    wide moving(const range_map<T>& by, const depth_time_range<T>& path) const
    {
        const receiver_path<T> whole{path, T(0.5), T(0.5), T(1), T(0.5), T(0.5), T(1)};
        return wide(moving_intensity(by, whole, path.t0, path.t1));
    }
    wide static_share(const range_map<T>& by, const static_receiver<T>& r) const
    {
        return wide(static_intensity(by, T(0.5), T(0.5), r));
    }
    wide at_once(const range_map<T>& by, const static_receiver<T>& r) const
    {
        const placed_receiver<T> placed{T(0.5), T(0.5), r};
        T found = 0;
        static_intensities<T>(by, std::span(&placed, 1), std::span(&found, 1));
        return wide(found);
    }
};

/// Distance of the look-ups from the answers of all ranges for receivers a slack nearer or farther, over the stated
/// error.
///
/// A crossing moves by times in which both depths differ by 84 u at most, a cut moves a line by 10 u, and the receiver
/// is known to be behind it within 26 u (range_crossing, range_depth, range_occluding_part): the slack, twice for lists
/// resolved twice. The error: 32 u a span (static_receiver_end), of which two layers have n (n + 1) at most if all n
/// ranges cross one another.
template <class T> double excess(const list<T>& ranges, const depth_time_range<T>& path, range_ids ids)
{
    double most = 0;
    for (int steps = 1; steps <= 2; ++steps) {
        const one_texel<T> texel(steps == 1 ? resolved(ranges, ids) : resolved_in_steps(ranges, ids), ids);
        const auto ask = [&](wide found, const depth_time_range<T>& seen) {
            const wide slack = 120 * steps * rounding<T>;
            const wide low = hidden_share(ranges, seen, -slack), high = hidden_share(ranges, seen, slack);
            const wide spans = wide(ranges.size() * (ranges.size() + 1));
            const wide error = 32 * spans * rounding<T> / (wide(seen.t1) - wide(seen.t0));
            most = std::max(most, double(std::max(low - found, found - high) / error));
        };
        ask(texel.moving(texel.map(), path), path);
        ask(texel.moving(texel.with_summaries(), path), path);
        depth_time_range<T> level = path;
        level.z1 = level.z0;
        const auto at_rest = [&](const depth_time_range<T>& seen) {
            const auto r = static_receiver_begin(seen.z0, seen.id, seen.t0, seen.t1);
            for (const range_map<T>& by : {texel.map(), texel.with_summaries()})
                ask(texel.static_share(by, r), seen), ask(texel.at_once(by, r), seen);
        };
        at_rest(level);
        level.t0 = 0, level.t1 = 1; // of which summaries are
        at_rest(level);
    }
    return most;
}

/// Ranges of few ids, so that a receiver's own range is often in front, and an id without a range.
template <class T> list<T> any_ranges(bit_source& bits, std::size_t most)
{
    list<T> ranges(bits.below(most + 1));
    const bool coarse = bits.chance(0.3), whole = bits.chance(0.3);
    const std::uint64_t ids = 1 + bits.below(4);
    const auto depth = [&] { return T(coarse ? double(bits.below(5)) / 2 - 1 : bits.uniform(-1, 1)); };
    const auto time = [&] { return coarse ? double(bits.below(5)) / 4 : bits.uniform(0, 1); };
    for (auto& r : ranges) {
        const double a = whole ? 0 : time(), b = whole ? 1 : time(), z = double(depth());
        r = range_between(T(a), T(z), T(b), bits.chance(0.3) ? T(z) : depth(), T(bits.below(ids)));
    }
    return ranges;
}

} // namespace

TEST_CASE_TEMPLATE("ids of any kind: every receiver gets the answer of all ranges", T, float, double)
{
    bit_source bits(71);
    std::int64_t behind_own = 0;
    for (std::int64_t i = 0; i < effort(4000); ++i) {
        const list<T> ranges = any_ranges<T>(bits, i % 50 == 0 ? 40 : 8);
        for (int id = 0; id < 5; ++id) {
            const depth_time_range<T> path{T(bits.uniform(0, 0.4)), T(bits.uniform(0.6, 1)), T(bits.uniform(-1.2, 1.2)),
                                           T(bits.uniform(-1.2, 1.2)), T(id)};
            REQUIRE(excess(ranges, path, range_ids::any) <= 1);
            behind_own += excess(ranges, path, range_ids::surfaces) > 1;
        }
    }
    CHECK(behind_own > 0); // the second layer is needed
}

TEST_CASE_TEMPLATE("ids of surfaces: every receiver that is not behind its own surface gets the answer of all ranges",
                   T, float, double)
{
    bit_source bits(72);
    for (std::int64_t i = 0; i < effort(4000); ++i) {
        const list<T> ranges = any_ranges<T>(bits, i % 50 == 0 ? 40 : 8);
        for (int id = 0; id < 5; ++id) {
            T most = T(1.2);
            for (const auto& r : ranges)
                if (r.id == T(id)) most = std::min({most, r.z0, r.z1});
            const auto depth = [&] { return T(bits.uniform(-1.2, double(most))); };
            const depth_time_range<T> path{T(bits.uniform(0, 0.4)), T(bits.uniform(0.6, 1)), depth(), depth(), T(id)};
            REQUIRE(excess(ranges, path, range_ids::surfaces) <= 1);
        }
    }
}

TEST_CASE_TEMPLATE("ids of any kind: a climber finds no larger error", T, float, double)
{
    constexpr std::size_t count = 6;
    const auto search = [](range_ids ids, std::int64_t evaluations) {
        return climb(5 * count + 5, evaluations, 73, [&](const std::vector<double>& place) {
            list<T> ranges;
            std::size_t used = 0;
            const auto take = [&] { return place[used++]; };
            const auto depth = [&] { return T(2 * take() - 1); };
            for (std::size_t i = 0; i < count; ++i) {
                const T a = T(take()), b = T(take()), z0 = depth(), z1 = depth(), id = T(std::floor(2.99 * take()));
                ranges.push_back(range_between(a, z0, b, z1, id));
            }
            const T t0 = T(0.4 * take()), t1 = T(0.6 + 0.4 * take()), z0 = depth(), z1 = depth();
            return excess(ranges, {t0, t1, z0, z1, T(std::floor(2.99 * take()))}, ids);
        });
    };
    CHECK(search(range_ids::any, 20'000).score <= 1);
    CHECK(search(range_ids::surfaces, 2000).score > 1);
}

TEST_CASE("resolve_ranges: the second layer follows the span in front of it")
{
    // A table of id 1 in two parts over a ground of id 1, with a leaf between them.
    const list<float> ranges{
        {0, 0.5f, -0.5f, -0.5f, 1}, {0.5f, 1, -0.5f, -0.5f, 1}, {0, 1, 0.5f, 0.5f, 1}, {0.25f, 0.75f, 0, 0, 2}};
    const list<float> spans = resolved(ranges, range_ids::any);
    const std::vector<std::vector<float>> expected{{0, 0.5f, 1}, {0.25f, 0.5f, 2}, {0.5f, 1, 1}, {0.5f, 0.75f, 2}};
    REQUIRE(spans.size() == expected.size());
    depth_time_range<float> front = range_empty(float(range_nothing));
    for (std::size_t i = 0; i < spans.size(); ++i) {
        CHECK(std::vector{spans[i].t0, spans[i].t1, spans[i].id} == expected[i]);
        CHECK(range_is_second_layer(front, spans[i]) == (i % 2 == 1));
        if (i % 2 == 0) front = spans[i];
    }
    const auto shadow = [&](float z, float id) {
        const one_texel<float> texel(spans, range_ids::any);
        return double(texel.static_share(texel.with_summaries(), static_receiver_begin(z, id, 0.f, 1.f)));
    };
    CHECK(shadow(0.5f, 1) == 0.5); // the ground sees the leaf alone
    CHECK(shadow(0.5f, 2) == 1);
    CHECK(shadow(0.5f, 3) == 1);
    CHECK(shadow(-0.25f, 1) == 0);
    CHECK(resolved(ranges, range_ids::surfaces).size() == 2);
    CHECK(summarize<float>(spans, range_ids::surfaces).id == 1); // who promises too much keeps the second layer
}

TEST_CASE_TEMPLATE("summarize: occluded at all times if and only if spans fill the whole time", T, float, double)
{
    bit_source bits(74);
    std::int64_t always = 0;
    const std::int64_t cases = effort(20'000);
    for (std::int64_t i = 0; i < cases; ++i) {
        std::vector<T> times(1 + bits.below(6));
        for (T& t : times) t = T(bits.uniform(0, 1));
        times.insert(times.end(), {T(0), T(1)});
        std::ranges::sort(times);
        const std::size_t missing = bits.below(2 * times.size()); // or none
        list<T> spans;
        for (std::size_t k = 0; k + 1 < times.size(); ++k)
            if (k != missing && times[k] < times[k + 1])
                spans.push_back(
                    {times[k], times[k + 1], T(bits.uniform(-1, 1)), T(bits.uniform(-1, 1)), T(bits.below(3))});
        const bool filled = missing + 1 >= times.size() || times[missing] == times[missing + 1];
        REQUIRE((summarize<T>(spans, range_ids::any).shadowed == 1) == filled);
        always += filled;
    }
    CHECK(always > 0);
    CHECK(always < cases);
}

#if defined(__cpp_exceptions)
TEST_CASE("set_summaries refuses sizes that do not fit")
{
    const one_texel<float> texel({{0, 1, 0, 0, 1}}, range_ids::any);
    std::vector<range_summary<float>> summaries(texel.summaries.size());
    range_map<float> map = texel.map();
    map.width = 2 * map.tile;
    CHECK_THROWS_WITH_AS(set_summaries(map, std::span(summaries), range_ids::any),
                         doctest::Contains("range summaries: map.first.size() is"), std::invalid_argument);
    map = texel.map();
    map.ranges = map.ranges.first(0);
    CHECK_THROWS_WITH_AS(set_summaries(map, std::span(summaries), range_ids::any),
                         doctest::Contains("but map.ranges.size() is 0"), std::invalid_argument);
    summaries.pop_back();
    CHECK_THROWS_WITH_AS(set_summaries(texel.map(), std::span(summaries), range_ids::any),
                         doctest::Contains("range summaries: summaries.size() + 1 is"), std::invalid_argument);
}
#endif
