// The format of compact spans: exact codes, and ranges for any bits.
#include "support/effort.hpp"
#include "support/hostile.hpp"

#include <gnomon/passes/range/compact.hpp>
#include <gnomon/passes/range/look_up.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

using namespace gnomon;
using gnomon::test::bit_source;

TEST_CASE("the code of a depth is the last step that is not farther")
{
    for (std::uint64_t code = 0; code < std::uint64_t(compact_depths); ++code) {
        const float z = compact_depth(code);
        REQUIRE(double(z) == double(code) / (compact_depths / 2) - 1); // exact
        REQUIRE(compact_depth_code(double(z)) == code);
        REQUIRE(compact_depth_code(double(z) + 0x1p-52) == code);
        REQUIRE(compact_depth_code(double(z) - 0x1p-52) == (code > 0 ? code - 1 : 0));
    }
    CHECK(compact_depth_code(1) == compact_depths - 1);
    CHECK(compact_depth_code(std::numeric_limits<double>::infinity()) == compact_depths - 1);
    CHECK(compact_depth_code(-std::numeric_limits<double>::infinity()) == 0);
    CHECK(compact_depth_code(std::numeric_limits<double>::quiet_NaN()) == compact_depths - 1);
}

TEST_CASE("a body holds two depths and an id")
{
    const std::uint64_t body = compact_body(-0.5, 0.25, 0xabcdef);
    CHECK(compact_depth(body) == -0.5f);
    CHECK(compact_depth(body >> 20) == 0.25f);
    CHECK((body >> 40) == 0xabcdef);
}

TEST_CASE("spans of any bits read as empty ranges or ranges within the unit interval, and look-ups stay in [0, 1]")
{
    constexpr std::size_t side = 8, spans = 100;
    bit_source bits(71);
    std::vector<std::uint32_t> groups(range_map<float>::texels(side, side) / compact_spans::group);
    std::vector<std::uint16_t> lists(range_map<float>::texels(side, side));
    std::size_t some = 0, all = 0;
    for (std::int64_t n = 0; n < test::effort(300); ++n) {
        std::vector<std::uint16_t> begins(spans);
        std::vector<std::uint64_t> bodies(spans);
        for (std::uint16_t& b : begins) b = static_cast<std::uint16_t>(bits.below(1 << 16));
        for (std::uint64_t& b : bodies)
            b = bits.below(1 << 20) | std::uint64_t(bits.below(1 << 20)) << 20 |
                std::uint64_t(bits.chance(0.3) ? 0xfffffd + bits.below(3) : bits.below(1 << 24)) << 40;
        std::vector<std::size_t> first(lists.size());
        for (std::size_t& f : first) f = 5 * bits.below(spans / 5 + 1);
        std::sort(first.begin(), first.end());
        for (std::size_t i = 0; i < lists.size(); ++i) {
            if (i % compact_spans::group == 0) groups[i / compact_spans::group] = static_cast<std::uint32_t>(first[i]);
            lists[i] = static_cast<std::uint16_t>(first[i] - groups[i / compact_spans::group]);
        }
        const compact_range_map map{side, side, {begins, bodies, groups, lists}};
        std::size_t count = 0;
        for (std::size_t i = 0; i < lists.size(); ++i) {
            const compact_list list = map[i];
            std::size_t k = 0;
            for (const depth_time_range<float>& r : list) {
                const depth_time_range<float> same = list[k++];
                REQUIRE((r.t0 == same.t0 && r.t1 == same.t1 && r.z0 == same.z0 && r.z1 == same.z1 && r.id == same.id));
                if (!(r.t0 < r.t1)) continue;
                REQUIRE((0 <= r.t0 && r.t1 <= 1 && -1 <= r.z0 && r.z0 <= 1 && -1 <= r.z1 && r.z1 <= 1));
                REQUIRE((r.id == float(range_mixed) || (0 <= r.id && r.id < 0x1p24f)));
                ++some;
            }
            REQUIRE(k == list.size());
            count += k, all += k;
        }
        REQUIRE(count == spans - first[0]);
        const float x = float(bits.uniform(0, side)), y = float(bits.uniform(0, side)), z = float(bits.uniform(-1, 2));
        const auto within = [](float intensity) { return 0 <= intensity && intensity <= 1; };
        REQUIRE(within(static_intensity(map, x, y, static_receiver_begin(z, 1.f, 0.f, 1.f), 3)));
        const receiver_path<float> path{{0, 1, z, 0, 1}, x, y, 1, y, x, 1};
        REQUIRE(within(moving_intensity(map, path, 0.f, 1.f, 2)));
        REQUIRE(within(intensity_at(map, path, 0.5f, 0.f)));
    }
    CHECK(some > all / 10);
}

TEST_CASE("time without a range reads as an empty range, at any depth of a receiver")
{
    const std::vector<std::uint16_t> begins{0, 0x8000, 7}, lists{0, 2};
    const std::vector<std::uint64_t> bodies{compact_body(1, 1, compact_nothing), compact_body(-1, -1, 3),
                                            compact_body(0, 0, 4)};
    const std::vector<std::uint32_t> groups{0};
    const compact_spans spans{begins, bodies, groups, lists};
    CHECK(spans.bytes() == 3 * 10 + 4 + 2 * 2);
    const compact_list list = spans[0];
    REQUIRE(list.size() == 2);
    CHECK(list[0].id == float(range_nothing));
    CHECK(range_intensity(list[0], 0.f, 2.f, 9.f, 0.f) == 0);
    CHECK((list[1].t0 == 0.5f && list[1].t1 == 1 && list[1].id == 3));
}
