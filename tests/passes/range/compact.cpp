// Compact lists: conservative and close to the lists that they are made of, looked up as their ranges are, and refused
// before anything is written.
#include "compact_maps.hpp"
#include "random_maps.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

using range = depth_time_range<float>;

constexpr double step = 1.0 / compact_times;

/// A resolved list of long spans and of spans shorter than a step, with gaps and without. Ids count its ranges.
std::vector<range> any_list(bit_source& bits)
{
    std::vector<range> list;
    double t = bits.below(2) ? bits.uniform(0, 0.3) : 0;
    while (t < 1 && list.size() < 12) {
        const double length = bits.below(3) ? bits.uniform(0, 0.4) : bits.uniform(0, 3 * step);
        const auto t0 = float(t), t1 = float(std::min(t + length, 1.0));
        const auto depth = [&] { return float(bits.below(20) ? bits.uniform(-1, 1) : bits.below(2) ? 1 : -1); };
        if (t0 < t1) list.push_back({t0, t1, depth(), depth(), float(list.size())});
        t = double(t1) + (bits.below(2) ? 0 : bits.below(2) ? bits.uniform(0, 0.2) : bits.uniform(0, 2 * step));
    }
    return list;
}

/// A map of 32 x 32 texels whose first lists are the given ones.
struct map_of_lists {
    std::vector<std::uint32_t> first{0};
    std::vector<range> ranges;

    explicit map_of_lists(const std::vector<std::vector<range>>& lists)
    {
        for (const auto& list : lists) {
            ranges.insert(ranges.end(), list.begin(), list.end());
            first.push_back(static_cast<std::uint32_t>(ranges.size()));
        }
        first.resize(range_map<float>::texels(32, 32) + 1, first.back());
    }
    range_map<float> map() const { return {32, 32, first, ranges}; }
};

double depth(const range& r, double time)
{
    const double passed = (time - double(r.t0)) / (double(r.t1) - double(r.t0));
    return double(r.z0) * (1 - passed) + double(r.z1) * passed;
}

template <class List> const range* range_at(const List& ranges, double time)
{
    for (const range& r : ranges)
        if (double(r.t0) <= time && time <= double(r.t1)) return &r;
    return nullptr;
}

/// Check the bounds that compact.hpp states at one time.
void check_bounds(const std::vector<range>& list, std::span<const range> compact, double time)
{
    const range *r = range_at(list, time), *c = range_at(compact, time);
    if (!r) {
        const auto near = [&](const range& l) { return double(l.t0) <= time + step && time - step <= double(l.t1); };
        if (c) REQUIRE(std::ranges::any_of(list, near));
        return;
    }
    REQUIRE(c);
    REQUIRE(depth(*c, time) <= depth(*r, time) + 1e-12);
    const range& owner = list[std::size_t(c->id)];
    const double lasts = double(owner.t1) - double(owner.t0);
    const double move = std::abs(double(owner.z1) - double(owner.z0)) / lasts * step;
    double least = depth(owner, time) - move;
    if (double(std::min(owner.z0, owner.z1)) - move < -1) return; // limited by the near plane
    if (lasts < 4 * step)
        for (const range& l : list)
            for (const double end : {std::max(double(l.t0), time - 6 * step), std::min(double(l.t1), time + 6 * step)})
                if (double(l.t0) <= end && end <= double(l.t1)) least = std::min(least, depth(l, end));
    REQUIRE(depth(*c, time) >= least - 0x1p-19 - 1e-9);
}

} // namespace

TEST_CASE("a compact list is nowhere farther than its list, and little nearer")
{
    bit_source bits(4);
    for (std::int64_t i = 0, n = effort(1'000); i < n; ++i) {
        std::vector<std::vector<range>> lists(100);
        for (auto& list : lists) list = any_list(bits);
        const map_of_lists map(lists);
        const compact_lists compact(map.map());
        const unpacked_lists unpacked(compact.spans);
        for (std::size_t k = 0; k < lists.size(); ++k) {
            const std::vector<range>& list = lists[k];
            REQUIRE(compact.spans[k].size() <= (list.empty() ? 0 : 2 * list.size() + 1));
            const auto found =
                std::span(unpacked.ranges).subspan(unpacked.first[k], unpacked.first[k + 1] - unpacked.first[k]);
            for (int q = 0; q < 8; ++q) {
                const range& near_one = list.empty() ? range_empty(0.f) : list[bits.below(list.size())];
                const double end = double(q % 4 ? near_one.t0 : near_one.t1) + bits.uniform(-1.5 * step, 1.5 * step);
                check_bounds(list, found, q % 2 ? bits.uniform(0, 1) : std::clamp(end, 0.0, 1.0));
            }
        }
    }
}

TEST_CASE("look-ups of a compact map equal those of its unpacked lists, bit for bit")
{
    bit_source bits(70);
    int shadowed = 0, asked = 0;
    for (std::int64_t n = 0; n < effort(200); ++n) {
        const random_map<float> random(bits, range_ids::surfaces);
        const compact_lists compact(random.map());
        const unpacked_lists unpacked(compact.spans);
        const range_map<float> plain{width, height, unpacked.first, unpacked.ranges};
        std::vector<range_summary<float>> summaries(unpacked.first.size() - 1);
        set_summaries(plain, std::span(summaries), bits.chance(0.5) ? range_ids::surfaces : range_ids::any);
        const bool summarized = bits.chance(0.5);
        const std::span<const range_summary<float>> some =
            summarized ? std::span(summaries) : std::span(summaries).first(0);
        const range_map<float> lists{width, height, unpacked.first, unpacked.ranges, some};
        const compact_range_map small{width, height, compact.spans, some};

        const int look_ups = 1 + int(bits.below(3));
        std::vector<placed_receiver<float>> receivers(30);
        for (auto& r : receivers)
            r = {float(bits.uniform(-2, 14)), float(bits.uniform(-2, 12)),
                 static_receiver_begin(float(bits.uniform(-1, 1.5)), float(bits.below(6)), 0.f,
                                       bits.chance(0.5) ? 1.f : float(bits.uniform(0.5, 1)))};
        std::vector<float> expected(receivers.size()), found(receivers.size());
        static_intensities<float>(lists, receivers, expected, look_ups);
        static_intensities<float>(small, receivers, found, look_ups);
        REQUIRE(found == expected);
        for (const auto& [x, y, state] : receivers) {
            const float intensity = static_intensity(lists, x, y, state, look_ups);
            REQUIRE(static_intensity(small, x, y, state, look_ups) == intensity);
            REQUIRE(static_intensity(small, x, y, state, look_ups, tent_shutter{}) ==
                    static_intensity(lists, x, y, state, look_ups, tent_shutter{}));
            ++asked, shadowed += intensity > 0 && intensity < 1;
        }
        for (int k = 0; k < 20; ++k) {
            receiver_path<float> path = any_path<float>(bits);
            path.depth.id = float(bits.below(6));
            const float end = float(bits.uniform(0.5, 1.2)), t = float(bits.uniform(0, 1));
            REQUIRE(moving_intensity(small, path, 0.f, end, look_ups) ==
                    moving_intensity(lists, path, 0.f, end, look_ups));
            REQUIRE(moving_intensity(small, path, 0.f, end, look_ups, tent_shutter{}) ==
                    moving_intensity(lists, path, 0.f, end, look_ups, tent_shutter{}));
            REQUIRE(intensity_at(small, path, t, 0.f, look_ups) == intensity_at(lists, path, t, 0.f, look_ups));
            REQUIRE(sampled_intensity(small, path, 0.f, 16.f) == sampled_intensity(lists, path, 0.f, 16.f));
        }
    }
    CHECK(shadowed > asked / 20);
}

#if defined(__cpp_exceptions)
namespace {

/// Check that compact_ranges refuses a map, and leaves the memory as it was.
void expect_refusal(const range_map<float>& map, std::array<std::size_t, 4> sizes, const char* message)
{
    std::vector<std::uint16_t> begins(sizes[0], 7), lists(sizes[3], 7);
    std::vector<std::uint64_t> bodies(sizes[1], 7);
    std::vector<std::uint32_t> groups(sizes[2], 7);
    CHECK_THROWS_WITH_AS(compact_ranges(map, {begins, bodies, groups, lists}), doctest::Contains(message),
                         std::invalid_argument);
    const auto untouched = [](const auto& memory) {
        return std::ranges::all_of(memory, [](auto x) { return x == 7; });
    };
    CHECK((untouched(begins) && untouched(bodies) && untouched(groups) && untouched(lists)));
}

} // namespace

TEST_CASE("compact_ranges refuses memory that is too small, and ranges that it cannot hold, before it writes")
{
    const std::vector<range> fine{{0, 0.5f, 0, 0, 1}, {0.5f, 1, 0, 0, 2}};
    const map_of_lists map({fine, {}, fine});
    const std::array<std::size_t, 4> enough{10, 10, 16, 1024};
    REQUIRE(compact_capacity(map.map()) == enough[0]);
    CHECK(compact_lists(map.map()).spans.begins.size() == 4);
    expect_refusal(map.map(), {9, 10, 16, 1024}, "memory.begins.size() is 9, but compact_capacity(map) is 10");
    expect_refusal(map.map(), {10, 9, 16, 1024}, "memory.bodies.size() is 9, but compact_capacity(map) is 10");
    expect_refusal(map.map(), {10, 10, 15, 1024}, "memory.groups.size() is 15, but texels / 64 is 16");
    expect_refusal(map.map(), {10, 10, 16, 1023}, "memory.lists.size() is 1023, but texels is 1024");
    range_map<float> wrong = map.map();
    wrong.width = 33;
    expect_refusal(wrong, enough, "compact ranges: map.first.size() is");

    const float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    const auto refused = [&](const range& r, const char* message) {
        const map_of_lists hostile({fine, {}, {fine[0], r}});
        expect_refusal(hostile.map(), enough, message);
    };
    refused({0.25f, 1, 0, 0, 2}, "list 2, range 1: its times are not in [0, 1], in order and disjoint");
    refused({0.5f, 1.25f, 0, 0, 2}, "list 2, range 1: its times");
    refused({-0.5f, 1, 0, 0, 2}, "list 2, range 1: its times");
    refused({0.5f, infinity, 0, 0, 2}, "list 2, range 1: its times");
    for (const float z : {infinity, -infinity, nan}) {
        refused({0.5f, 1, z, 0, 2}, "list 2, range 1: its depths are not finite");
        refused({0.5f, 1, 0, z, 2}, "list 2, range 1: its depths are not finite");
    }
    for (const float id : {0x1p24f, 16777214.f, 0.5f, -2.f, infinity, nan})
        refused({0.5f, 1, 0, 0, id}, "list 2, range 1: its id is");

    // Empty ranges, among them those with a NaN time, add nothing; ids up to the last, and range_mixed, are kept.
    const std::vector<range> odd{{1, 0, nan, 0, -9}, {nan, 1, 0, 0, 1}, {0, 0.5f, 0, 0, 16777213}, {0.5f, 1, 0, 0, -1}};
    const map_of_lists kept({odd});
    const compact_lists compact(kept.map());
    REQUIRE(compact.spans[0].size() == 2);
    CHECK(compact.spans[0][0].id == 16777213);
    CHECK(compact.spans[0][1].id == float(range_mixed));
}

TEST_CASE("compact_ranges refuses lists whose begins 16 bits cannot tell apart, and no others")
{
    const auto lists_of = [](std::size_t ranges) {
        std::vector<std::vector<range>> lists(64);
        for (std::size_t i = 0; i < ranges; ++i) { // 2 spans for each range, and one more for each list
            const float t = float(i % 1024 * 2 + 1) / 4096;
            lists[i / 1024].push_back({t, t + 1.f / 4096, 0, 0, 1});
        }
        return lists;
    };
    const map_of_lists fits(lists_of(32'751)), overflows(lists_of(32'752));
    const compact_lists compact(fits.map());
    CHECK(compact.spans.lists[63] == 2 * 32'751 + 32);
    CHECK(compact.spans[63].empty());
    const std::size_t room = compact_capacity(overflows.map());
    expect_refusal(overflows.map(), {room, room, 16, 1024},
                   "spans of 63 lists is 65536, but the largest number is 65535");
}
#endif
