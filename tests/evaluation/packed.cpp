// Lists in few bits: packed spans, and lists of a fixed capacity, which must not change what they promise.
#include "evaluation/motion/compact_spans.hpp"
#include "passes/range/range_questions.hpp"

#include <gnomon/motion/range/range_list.h>
#include <gnomon/passes/range/look_up.hpp>
#include <gnomon/passes/range/part.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

using namespace gnomon;
using namespace gnomon::evaluation;
using namespace gnomon::test;
using gnomon::renderer::moving_stage;

TEST_CASE("lists of any capacity shadow what exact ranges shadow, the larger the less more")
{
    std::array<int, 3> more{};
    std::array<float, 3> time{}, depth{};
    for (std::size_t k = 0; k < 3; ++k) {
        const auto lists = interval_lists(exact(), 4 << k);
        CHECK(lists.resolved);
        time[k] = lists.mean_time_added, depth[k] = lists.mean_depth_added;
        ask(3, [&](const question& q, bit_source&) {
            const float expected = front(exact().map()(q.x, q.y), q.t), found = front(lists.map()(q.x, q.y), q.t);
            // Without an overflow depths are cut twice, within 26 2^-24 each.
            REQUIRE(found <= expected + 4e-6f);
            more[k] += found < expected - 1e-4f;
        });
        for (std::size_t i = 0; i < resolution * resolution; ++i) {
            const auto list = lists.map()(i % resolution, i / resolution);
            REQUIRE(list.size() <= std::size_t(4 << k));
            for (std::size_t j = 1; j < list.size(); ++j) REQUIRE(list[j - 1].t1 <= list[j].t0);
        }
    }
    CHECK(more[0] > more[1]);
    CHECK(more[1] >= more[2]);
    CHECK(time[0] > time[1]);
    CHECK(depth[0] > depth[1]);
    CHECK_THROWS_WITH_AS(interval_lists(exact(), 5), "interval lists: capacity 5, 4, 8 and 16 are possible",
                         std::invalid_argument);
}

TEST_CASE("lists by packs have the bits of one texel alone")
{
    const moving_stage quads = renderer::crossed_quads(1);
    const auto all = exact_ranges(quads.world, quads.light, resolution);
    const auto lists = interval_lists(all, 16);
    std::array<int, 3> checked{}; // of one, two and more ranges
    for (std::size_t i = 0; i < texels_of(resolution); i += 3) {
        auto list = range_list_make<float, 16>(range_empty(0.f));
        std::vector<range> parted(list_of(all, i).begin(), list_of(all, i).end());
        part_neighbours(std::span(parted));
        for (const range& r : parted) list = range_list_insert(list, r);
        list = range_list_resolve(list);
        std::vector<range> expected;
        for (const range& r : list.ranges)
            if (r.t0 < r.t1) expected.push_back(r);
        REQUIRE(std::ranges::equal(list_of(lists, i), expected, equal));
        if (const std::size_t count = list_of(all, i).size()) ++checked[std::min<std::size_t>(count, 3) - 1];
    }
    for (const int some : checked) CHECK(some > 100);
}

TEST_CASE("packed spans are never farther than the list, and little nearer")
{
    bit_source bits(4);
    constexpr double step = 1 / span_times;
    compact_spans packed;
    for (std::int64_t i = 0, n = effort(20'000); i < n; ++i) {
        // Long spans and ones shorter than a step, with gaps and without.
        std::vector<range> list;
        double t = bits.below(2) ? bits.uniform(0, 0.3) : 0;
        while (t < 1 && list.size() < 12) {
            const double length = bits.below(3) ? bits.uniform(0, 0.4) : bits.uniform(0, 3 * step);
            const auto t0 = float(t), t1 = float(std::min(t + length, 1.0));
            const auto depth = [&] { return float(bits.below(20) ? bits.uniform(-1, 1) : bits.below(2) ? 1 : -1); };
            if (t0 < t1) {
                list.push_back({t0, t1, depth(), depth(), float(list.size())});
            }
            t = double(t1) + (bits.below(2) ? 0 : bits.below(2) ? bits.uniform(0, 0.2) : bits.uniform(0, 2 * step));
        }
        packed.clear();
        for (std::size_t k = bits.below(100); k > 0; --k) compact_list(std::array{range{0, 0.5f, 0, 0, 0}}, packed);
        const std::size_t place = packed.lists.size(), before = packed.begins.size();
        compact_list(list, packed);
        REQUIRE(packed.begins.size() - before <= 2 * list.size() + 1);
        compact_list({}, packed);
        std::vector<range> unpacked;
        for_each_span(packed, place, [&](const range& r) { unpacked.push_back(r); });
        const auto at = [](const std::vector<range>& ranges, double time) -> const range* {
            for (const range& r : ranges)
                if (double(r.t0) <= time && time <= double(r.t1)) return &r;
            return nullptr;
        };
        const auto depth = [](const range& r, double time) {
            const double passed = (time - double(r.t0)) / (double(r.t1) - double(r.t0));
            return double(r.z0) * (1 - passed) + double(r.z1) * passed;
        };
        for (int k = 0; k < 40; ++k) {
            const range& near_one = list.empty() ? range_empty(0.f) : list[bits.below(list.size())];
            const double time =
                k % 2 ? bits.uniform(0, 1)
                      : std::clamp(double(k % 4 ? near_one.t0 : near_one.t1) + bits.uniform(-1.5 * step, 1.5 * step),
                                   0.0, 1.0);
            const range *r = at(list, time), *p = at(unpacked, time);
            if (!r) {
                const auto near = [&](const range& l) {
                    return double(l.t0) <= time + step && time - step <= double(l.t1);
                };
                if (p) REQUIRE(std::ranges::any_of(list, near));
                continue;
            }
            REQUIRE(p);
            REQUIRE(depth(*p, time) <= depth(*r, time) + 1e-12);
            // A line moves by its own change in one step; short ones are as near as anything within six.
            const range& owner = list[std::size_t(p->id)];
            const double lasts = double(owner.t1) - double(owner.t0);
            const double move = std::abs(double(owner.z1) - double(owner.z0)) / lasts * step;
            double least = depth(owner, time) - move;
            if (double(std::min(owner.z0, owner.z1)) - move < -1) continue; // limited by the near plane
            if (lasts < 4 * step)
                for (const range& l : list)
                    for (const double end :
                         {std::max(double(l.t0), time - 6 * step), std::min(double(l.t1), time + 6 * step)})
                        if (double(l.t0) <= end && end <= double(l.t1)) least = std::min(least, depth(l, end));
            REQUIRE(depth(*p, time) >= least - 0x1p-19 - 1e-9);
        }
    }
    CHECK_THROWS_WITH_AS(compact_list(std::array{range{0, 1, 0, 0, 0x1p24f}}, packed),
                         "packed spans: id 16777216, 0 to 16777213 are possible", std::invalid_argument);
}

TEST_CASE("packed maps are close to the resolved ones, less than half as large, and looked up as they are")
{
    const auto resolved = with_totals(resolved_ranges(cubes().world, cubes().light, resolution));
    const auto packed = compact_ranges(resolved);
    range_shadow_map unpacked = resolved;
    unpacked.first.clear(), unpacked.ranges.clear();
    for (std::size_t i = 0; i < texels_of(resolution); ++i) {
        unpacked.first.push_back(std::uint32_t(unpacked.ranges.size()));
        for_each_span(packed.spans, i, [&](const range& r) { unpacked.ranges.push_back(r); });
    }
    unpacked.first.push_back(std::uint32_t(unpacked.ranges.size()));
    int asked = 0, other = 0, shadowed = 0;
    ask(5, [&](const question& q, bit_source& bits) {
        const float expected = front(resolved.map()(q.x, q.y), q.t), found = front(unpacked.map()(q.x, q.y), q.t);
        REQUIRE(found <= expected + 1e-6f); // of range_depth, twice
        ++asked;
        other += found < expected - 1e-5f;
        const auto receiver = static_receiver_begin(float(bits.uniform(-1, 1.1)), -3.f, 0.f, 1.f);
        const float x = float(bits.uniform(-2, resolution + 2)), y = float(bits.uniform(-2, resolution + 2));
        const float shadow = evaluation::static_intensity(packed, x, y, receiver);
        REQUIRE(shadow == gnomon::static_intensity(unpacked.map(), x, y, receiver));
        shadowed += shadow > 0 && shadow < 1;
    });
    CHECK(other < asked / 200);
    CHECK(shadowed > asked / 20);
    CHECK(2 * packed.bytes < resolved.bytes + packed.totals.size() * sizeof packed.totals[0]);
}

TEST_CASE("packed, the ranges of casters take at most a third of what all ranges take, however many cubes")
{
    for (const int count : {100, 200, 400, 800}) {
        const moving_stage stage = renderer::random_cubes(1, count, 0.5f);
        const auto all = exact_ranges(stage.world, stage.light, 256);
        const auto packed = compact_ranges(caster_ranges(stage.world, stage.light, 256));
        CHECK(3 * packed.bytes <= all.bytes);
    }
}
