// Maps in less memory: compact lists, and lists of a fixed capacity.
#include "evaluation/motion/packed_map.hpp"
#include "passes/range/compact_maps.hpp"
#include "range_questions.hpp"

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
        const auto lists = built("interval_lists", {{"capacity", 4 << k}});
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
    CHECK_THROWS_WITH_AS(built("interval_lists", {{"capacity", 5}}),
                         "interval lists: capacity 5, 4, 8 and 16 are possible", std::invalid_argument);
}

TEST_CASE("lists by packs have the bits of one texel alone")
{
    const moving_stage quads = renderer::crossed_quads(1);
    const auto all = built("exact_ranges", {}, quads);
    const auto lists = built("interval_lists", {{"capacity", 16}}, quads);
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

TEST_CASE("compact maps are close to the resolved ones, less than half as large, and looked up as they are")
{
    const auto resolved = with_totals(built("resolved_ranges"));
    const packed_map compact = packed_map_of(resolved);
    const unpacked_lists lists(compact.map().spans);
    range_map<float> unpacked = resolved.map();
    unpacked.first = lists.first, unpacked.ranges = lists.ranges;
    int asked = 0, other = 0, shadowed = 0;
    ask(5, [&](const question& q, bit_source& bits) {
        const float expected = front(resolved.map()(q.x, q.y), q.t), found = front(unpacked(q.x, q.y), q.t);
        REQUIRE(found <= expected + 1e-6f); // of range_depth, twice
        ++asked;
        other += found < expected - 1e-5f;
        const auto receiver = static_receiver_begin(float(bits.uniform(-1, 1.1)), -3.f, 0.f, 1.f);
        const float x = float(bits.uniform(-2, resolution + 2)), y = float(bits.uniform(-2, resolution + 2));
        const float shadow = static_intensity(compact.map(), x, y, receiver);
        REQUIRE(shadow == static_intensity(unpacked, x, y, receiver));
        shadowed += shadow > 0 && shadow < 1;
    });
    CHECK(other < asked / 200);
    CHECK(shadowed > asked / 20);
    CHECK(2 * compact.bytes < resolved.bytes + compact.totals.size() * sizeof compact.totals[0]);
}

TEST_CASE("compact, the ranges of casters take at most a third of what all ranges take, however many cubes")
{
    for (const int count : {100, 200, 400, 800}) {
        const moving_stage stage = renderer::random_cubes(1, count, 0.5f);
        const auto all = built("exact_ranges", {}, stage, 256);
        const auto compact = packed_map_of(built("caster_ranges", {}, stage, 256));
        CHECK(3 * compact.bytes <= all.bytes);
    }
}
