// Shadow maps of ranges, one kind against another: what each leaves out, or rounds, must not change what it promises.
#include "../support/effort.hpp"
#include "../support/hostile.hpp"

#include <gnomon/passes/range_look_up.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "motion/cube_curves.hpp"
#include "motion/packed_spans.hpp"
#include "motion/range_maps.hpp"
#include "motion/shadow_tests.hpp"
#include "toolbox/camera.hpp"
#include "toolbox/moving_stages.hpp"
#include "toolbox/surface_ids.hpp"

using namespace gnomon;
using namespace gnomon::demo;
using gnomon::test::bit_source;
using gnomon::test::effort;
using gnomon::toolbox::moving_stage;

namespace {

using range = depth_time_range<float>;

constexpr int resolution = 128;

const moving_stage& cubes()
{
    static const moving_stage stage = toolbox::random_cubes(1, 400, 1);
    return stage;
}

const range_shadow_map& exact()
{
    static const range_shadow_map map = exact_ranges(cubes().world, cubes().light, resolution);
    return map;
}

float front(std::span<const range> list, float t)
{
    float nearest = 2;
    for (const range& r : list)
        if (r.t0 <= t && t < r.t1) nearest = std::min(nearest, range_depth(r, t));
    return nearest;
}

float intensity(std::span<const range> list, float t, float z, float id)
{
    float result = 0;
    for (const range& r : list) result = std::max(result, range_intensity(r, t, z, id, 0.f));
    return result;
}

struct question {
    std::size_t x, y;
    float t;
};

template <class Ask> void ask(std::uint64_t seed, const Ask& visit)
{
    bit_source bits(seed);
    for (std::int64_t i = 0, n = effort(20'000); i < n; ++i) {
        const std::size_t x = bits.below(resolution), y = bits.below(resolution);
        visit(question{x, y, static_cast<float>(bits.uniform(0, 1))}, bits);
    }
}

bool equal(const range& r, const range& s)
{
    return r.t0 == s.t0 && r.t1 == s.t1 && r.z0 == s.z0 && r.z1 == s.z1 && r.id == s.id;
}

bool same_maps(const range_shadow_map& a, const range_shadow_map& b)
{
    return a.first == b.first && std::ranges::equal(a.ranges, b.ranges, equal) && a.bytes == b.bytes;
}

} // namespace

TEST_CASE("resolved ranges have the front of the exact ones, as have prisms where nothing turns")
{
    for (const bool perspective : {true, false}) {
        toolbox::moving_camera light = cubes().light;
        if (!perspective)
            light = {toolbox::orthographic_view(toolbox::bounds_of(cubes().world).corners(), {0.3, -1, 0.2})};
        const auto all = exact_ranges(cubes().world, light, resolution);
        const auto resolved = resolved_ranges(cubes().world, light, resolution);
        const auto prisms = prism_ranges(cubes().world, light, resolution);
        int asked = 0, other_front = 0, other_prism = 0;
        ask(1, [&](const question& q, bit_source&) {
            const auto differs = [&](const range_shadow_map& m, float tolerance) {
                return !(std::abs(front(m.map()(q.x, q.y), q.t) - front(all.map()(q.x, q.y), q.t)) < tolerance);
            };
            ++asked;
            other_front += differs(resolved, 1e-5f);
            other_prism += differs(prisms, 1e-5f);
        });
        // Where fronts change, rounding decides.
        CHECK(other_front <= asked / 2000);
        CHECK(other_prism <= asked / 2000);
    }
}

TEST_CASE("a cover changes no shadow test, whoever asks")
{
    const auto covered = covered_ranges(exact());
    CHECK(covered.covers > 1000);
    CHECK(covered.ranges.size() < exact().ranges.size());
    const auto by_passes = covered_prism_ranges(cubes().world, cubes().light, resolution);
    const auto prisms = prism_ranges(cubes().world, cubes().light, resolution);
    CHECK(by_passes.covers > 1000);
    int shadowed = 0;
    ask(2, [&](const question& q, bit_source& bits) {
        const auto all = exact().map()(q.x, q.y), kept = covered.map()(q.x, q.y);
        const auto z = static_cast<float>(bits.uniform(-1, 1));
        REQUIRE(intensity(kept, q.t, z, -3) == intensity(all, q.t, z, -3));
        shadowed += intensity(all, q.t, z, -3) > 0;
        // On the surfaces themselves.
        for (const range& r : all)
            if (r.t0 <= q.t && q.t <= r.t1) {
                const float own = range_depth(r, q.t);
                REQUIRE(intensity(kept, q.t, own, r.id) == intensity(all, q.t, own, r.id));
            }
        REQUIRE(intensity(by_passes.map()(q.x, q.y), q.t, z, -3) == intensity(prisms.map()(q.x, q.y), q.t, z, -3));
    });
    CHECK(shadowed > effort(20'000) / 20);
}

TEST_CASE("a cut range that covers is a cover, as many as of prisms, and changes no shadow test")
{
    const moving_stage turning = toolbox::cube_over_plane(1, 20, 2, 0);
    const auto all = exact_ranges(turning.world, turning.light, resolution);
    const auto covered = covered_ranges(all);
    const auto prisms = covered_prism_ranges(turning.world, turning.light, resolution);
    CHECK(prisms.covers > 1000);
    // Prisms pair only two fragments: where a triangle's edge passes a texel they may find what edge functions do not.
    CHECK(double(covered.covers) == doctest::Approx(double(prisms.covers)).epsilon(0.02));
    int shadowed = 0;
    ask(6, [&](const question& q, bit_source& bits) {
        const auto list = all.map()(q.x, q.y), kept = covered.map()(q.x, q.y);
        const auto z = static_cast<float>(bits.uniform(-1, 1));
        REQUIRE(intensity(kept, q.t, z, -3) == intensity(list, q.t, z, -3));
        shadowed += intensity(list, q.t, z, -3) > 0;
    });
    CHECK(shadowed > effort(20'000) / 20);
}

TEST_CASE("a cover that is asked first answers as the list does")
{
    for (const moving_stage& stage : {cubes(), toolbox::cube_over_plane(1, 20, 2, 0)}) {
        const auto all = exact_ranges(stage.world, stage.light, resolution);
        const auto first = cover_first_ranges(all);
        CHECK(first.covers > 1000);
        int decided = 0, other = 0;
        ask(7, [&](const question& q, bit_source& bits) {
            const auto z = static_cast<float>(bits.uniform(-1, 1));
            const float x = float(q.x) + 0.5f, y = float(q.y) + 0.5f; // one texel has all the weight
            const light_receiver r{{{0, 1, z, z, -3}, x, y, 1, x, y, 1}, {0, 1, 2, 2}};
            decided += first.texel_covers[range_map<float>::texel(resolution, q.x, q.y)].id >= 0;
            other += cover_first_visibility_at(first, r, q.t) != visibility_at(all.map(), r, q.t);
        });
        CHECK(decided > 100);
        CHECK(other == 0);
    }
}

TEST_CASE("ids of surfaces change ids alone, and merging lists keeps them")
{
    const auto ids = toolbox::surface_ids(cubes().world);
    const auto renamed = with_ids(exact(), ids);
    REQUIRE(renamed.ranges.size() == exact().ranges.size());
    for (std::size_t i = 0; i < renamed.ranges.size(); ++i) {
        range expected = exact().ranges[i];
        expected.id = float(ids[std::size_t(expected.id)]);
        REQUIRE(equal(renamed.ranges[i], expected));
    }
    const auto mixed = [](const range_shadow_map& m) {
        return std::ranges::count(m.ranges, float(range_mixed), &range::id);
    };
    CHECK(mixed(interval_lists(renamed, 4)) < mixed(interval_lists(exact(), 4)));
}

TEST_CASE("without backdrops, every surface of the scene gets the shadow it had")
{
    const auto casters = with_totals(caster_ranges(cubes().world, cubes().light, resolution));
    const auto resolved = resolved_ranges(cubes().world, cubes().light, resolution);
    CHECK(casters.ranges.size() < resolved.ranges.size());
    int asked = 0, shadowed = 0, other = 0;
    ask(5, [&](const question& q, bit_source&) {
        const auto all = exact().map()(q.x, q.y), kept = casters.map()(q.x, q.y);
        for (const range& r : all) {
            if (!(r.t0 <= q.t && q.t <= r.t1)) continue;
            const float own = range_depth(r, q.t) - 1e-5f, expected = intensity(all, q.t, own, r.id);
            ++asked, shadowed += expected > 0, other += intensity(kept, q.t, own, r.id) != expected;
        }
    });
    CHECK(shadowed > asked / 4);
    // Where fronts change, rounding decides.
    CHECK(other <= asked / 2000);
}

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

TEST_CASE("packed spans are never farther than the list, and little nearer")
{
    bit_source bits(4);
    constexpr double step = 1 / span_times;
    packed_spans packed;
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
        for (std::size_t k = bits.below(100); k > 0; --k) pack_spans(std::array{range{0, 0.5f, 0, 0, 0}}, packed);
        const std::size_t place = packed.lists.size(), before = packed.begins.size();
        pack_spans(list, packed);
        REQUIRE(packed.begins.size() - before <= 2 * list.size() + 1);
        pack_spans({}, packed);
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
    CHECK_THROWS_WITH_AS(pack_spans(std::array{range{0, 1, 0, 0, 0x1p24f}}, packed),
                         "packed spans: id 16777216, 0 to 16777213 are possible", std::invalid_argument);
}

TEST_CASE("packed maps are close to the resolved ones, less than half as large, and looked up as they are")
{
    const auto resolved = with_totals(resolved_ranges(cubes().world, cubes().light, resolution));
    const auto packed = packed_ranges(resolved);
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
        const float shadow = demo::static_shadow(packed, x, y, receiver);
        REQUIRE(shadow == gnomon::static_shadow(unpacked.map(), x, y, receiver));
        shadowed += shadow > 0 && shadow < 1;
    });
    CHECK(other < asked / 200);
    CHECK(shadowed > asked / 20);
    CHECK(2 * packed.bytes < resolved.bytes + packed.totals.size() * sizeof packed.totals[0]);
}

TEST_CASE("kinds of maps take the memory that they say, in the order that they should")
{
    const auto& stage = cubes();
    const auto packed = packed_ranges(resolved_ranges(stage.world, stage.light, resolution));
    const auto covered = covered_ranges(exact()), resolved = resolved_ranges(stage.world, stage.light, resolution),
               prisms = prism_ranges(stage.world, stage.light, resolution),
               covered_prisms = covered_prism_ranges(stage.world, stage.light, resolution);
    CHECK(packed.bytes < resolved.bytes);
    CHECK(resolved.bytes < covered.bytes);
    CHECK(covered.bytes < exact().bytes);
    CHECK(covered_prisms.bytes < prisms.bytes);
    CHECK(covered_prisms.building_bytes < prisms.building_bytes);
    for (const auto& m : {exact(), covered, resolved, prisms, covered_prisms, interval_lists(exact(), 4)})
        CHECK(m.bytes == 20 * m.ranges.size() + 4 * m.first.size());
    const auto first = cover_first_ranges(exact());
    CHECK(first.bytes == 20 * (first.ranges.size() + first.texel_covers.size()) + 4 * first.first.size());
    // Fragments come in pairs, but for what rounding takes.
    CHECK(double(prisms.building_bytes) ==
          doctest::Approx(double((2 * 16 + 24) * prisms.ranges.size() + 8 * 128 * 128)).epsilon(0.01));
    CHECK(same_maps(exact(), exact_ranges(stage.world, stage.light, resolution)));
    CHECK(same_maps(prisms, prism_ranges(stage.world, stage.light, resolution)));
    CHECK(same_maps(interval_lists(exact(), 4), interval_lists(exact(), 4)));
    CHECK(packed.spans.bodies == packed_ranges(resolved).spans.bodies);
    const auto casters = caster_ranges(stage.world, stage.light, resolution);
    const auto packed_casters = packed_ranges(casters);
    CHECK(casters.bytes < resolved.bytes);
    CHECK(packed_casters.bytes < packed.bytes);
    CHECK(with_totals(casters).bytes == casters.bytes + 16 * (casters.first.size() - 1));
}

TEST_CASE("packed, the ranges of casters take at most a third of what all ranges take, however many cubes")
{
    for (const int count : {100, 200, 400, 800}) {
        const moving_stage stage = toolbox::random_cubes(1, count, 0.5f);
        const auto all = exact_ranges(stage.world, stage.light, 256);
        const auto packed = packed_ranges(caster_ranges(stage.world, stage.light, 256));
        CHECK(3 * packed.bytes <= all.bytes);
    }
}

TEST_CASE("rows of curves have all maps, and pairs grow with the number, the speed and the size of cubes")
{
    std::size_t pairs = 0;
    for (const cube_case& some : {cube_case{20, 1}, {40, 1}, {40, 8}, {40, 8, 0.5f}}) {
        const auto row = cube_costs(some, 64);
        CHECK(row["maps"].size() == 8);
        for (const auto& map : row["maps"]) {
            CHECK(map["bytes"].get<double>() > 0);
            CHECK(map["build_ms"].get<double>() > 0);
        }
        CHECK(row["triangles"] == some.count * 12 + 2);
        CHECK(row["pairs"].get<std::size_t>() > pairs);
        pairs = row["pairs"].get<std::size_t>();
    }
}

TEST_CASE("coverage saves most of what prisms need where cubes are large and slow")
{
    const auto saved = [](const cube_case& some) {
        const moving_stage stage = toolbox::random_cubes(1, some.count, 0.5f * some.factor, some.half_extent);
        return double(prism_ranges(stage.world, stage.light, resolution).building_bytes) /
               double(covered_prism_ranges(stage.world, stage.light, resolution).building_bytes);
    };
    CHECK(saved({400, 1.f / 32, 0.5f}) > 4);
    CHECK(saved({400, 8, 0.5f}) < 2);
}
