// Shadow maps of ranges, one kind against another: what each leaves out, or rounds, must not change what it promises.
#include "evaluation/motion/cube_costs.hpp"
#include "evaluation/motion/packed_map.hpp"
#include "evaluation/motion/receivers/stochastic.hpp"
#include "range_questions.hpp"
#include "renderer/scene/camera.hpp"
#include "renderer/scene/moving_stages.hpp"
#include "renderer/scene/surface_ids.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

using namespace gnomon;
using namespace gnomon::evaluation;
using namespace gnomon::test;
using gnomon::renderer::moving_stage;

namespace {

bool same_maps(const range_shadow_map& a, const range_shadow_map& b)
{
    return a.first == b.first && std::ranges::equal(a.ranges, b.ranges, equal) && a.bytes == b.bytes;
}

} // namespace

TEST_CASE("resolved ranges have the front of the exact ones, as have prisms where nothing turns")
{
    for (const bool perspective : {true, false}) {
        renderer::moving_camera light = cubes().light;
        if (!perspective)
            light = {renderer::orthographic_view(renderer::bounds_of(cubes().world).corners(), {0.3, -1, 0.2})};
        map_source maps(cubes().world, light, resolution);
        const range_shadow_map all = *maps.map("exact_ranges"), resolved = *maps.map("resolved_ranges"),
                               prisms = *maps.map("prism_ranges");
        int asked = 0, other_front = 0, other_prism = 0;
        ask(1, [&](const question& q, bit_source&) {
            const auto differs = [&](const range_shadow_map& m, float tolerance) {
                return !(std::abs(front(m.map()(q.x, q.y), q.t) - front(all.map()(q.x, q.y), q.t)) < tolerance);
            };
            ++asked;
            other_front += differs(resolved, 1e-5f);
            other_prism += differs(prisms, 1e-5f);
        });
        // Rounding decides where fronts change.
        CHECK(other_front <= asked / 2000);
        CHECK(other_prism <= asked / 2000);
    }
}

TEST_CASE("a cover changes no shadow test, whoever asks")
{
    const auto covered = built("covered_ranges");
    CHECK(covered.covers > 1000);
    CHECK(covered.ranges.size() < exact().ranges.size());
    const auto by_passes = built("covered_prism_ranges");
    const auto prisms = built("prism_ranges");
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
    const moving_stage turning = renderer::cube_over_plane(1, 20, 2, 0);
    const auto all = built("exact_ranges", {}, turning);
    const auto covered = built("covered_ranges", {}, turning);
    const auto prisms = built("covered_prism_ranges", {}, turning);
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

TEST_CASE("a cover that is read first answers as the list does")
{
    for (const moving_stage& stage : {cubes(), renderer::cube_over_plane(1, 20, 2, 0)}) {
        const auto all = built("exact_ranges", {}, stage);
        const auto first = built("cover_first_ranges", {}, stage);
        CHECK(first.covers > 1000);
        int decided = 0, other = 0;
        ask(7, [&](const question& q, bit_source& bits) {
            const auto z = static_cast<float>(bits.uniform(-1, 1));
            const float x = float(q.x) + 0.5f, y = float(q.y) + 0.5f; // one texel has all the weight
            const light_receiver r{{{0, 1, z, z, -3}, x, y, 1, x, y, 1}, {0, 1, 2, 2}};
            decided += first.texel_covers[range_map<float>::texel(resolution, q.x, q.y)].id >= 0;
            other += cover_first_visibility_at(first, r, q.t) != visibility_at(all.map(), r, q.t);
        });
        CHECK((decided > 100 || draws_few()));
        CHECK(other == 0);
    }
}

TEST_CASE("ids of surfaces change ids alone, and merging lists keeps them")
{
    const auto ids = renderer::surface_ids(cubes().world);
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
    CHECK(mixed(built("interval_lists", {{"capacity", 4}, {"surfaces", 1}})) <
          mixed(built("interval_lists", {{"capacity", 4}})));
}

TEST_CASE("without backdrops, every surface of the scene gets the shadow it had")
{
    const auto casters = with_totals(built("caster_ranges"));
    const auto resolved = built("resolved_ranges");
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
    // Rounding decides where fronts change.
    CHECK(other <= asked / 2000);
}

TEST_CASE("kinds of maps take the memory that they say, in the order that they should")
{
    const auto packed = packed_map_of(built("resolved_ranges"));
    const auto covered = built("covered_ranges"), resolved = built("resolved_ranges"), prisms = built("prism_ranges"),
               covered_prisms = built("covered_prism_ranges");
    CHECK(packed.bytes < resolved.bytes);
    CHECK(resolved.bytes < covered.bytes);
    CHECK(covered.bytes < exact().bytes);
    CHECK(covered_prisms.bytes < prisms.bytes);
    CHECK(covered_prisms.building_bytes < prisms.building_bytes);
    for (const auto& m :
         {exact(), covered, resolved, prisms, covered_prisms, built("interval_lists", {{"capacity", 4}})})
        CHECK(m.bytes == 20 * m.ranges.size() + 4 * m.first.size());
    const auto first = built("cover_first_ranges");
    CHECK(first.bytes == 20 * (first.ranges.size() + first.texel_covers.size()) + 4 * first.first.size());
    // Fragments come in pairs, but for what rounding takes.
    CHECK(double(prisms.building_bytes) ==
          doctest::Approx(double((2 * 16 + 24) * prisms.ranges.size() + 8 * 128 * 128)).epsilon(0.01));
    CHECK(same_maps(exact(), built("exact_ranges")));
    CHECK(same_maps(prisms, built("prism_ranges")));
    CHECK(same_maps(built("interval_lists", {{"capacity", 4}}), built("interval_lists", {{"capacity", 4}})));
    CHECK(packed.bodies == packed_map_of(resolved).bodies);
    const auto casters = built("caster_ranges");
    const auto packed_casters = packed_map_of(casters);
    CHECK(casters.bytes < resolved.bytes);
    CHECK(packed_casters.bytes < packed.bytes);
    CHECK(with_totals(casters).bytes == casters.bytes + 16 * (casters.first.size() - 1));
}

TEST_CASE("rows of curves have all maps, and pairs grow with the number, the speed and the size of cubes")
{
    std::size_t pairs = 0;
    for (const cube_case& some : {cube_case{20, 1}, {40, 1}, {40, 8}, {40, 8, 0.5f}}) {
        const cube_costs row = costs_of(some, 64);
        CHECK(row.maps.size() >= 8);
        for (const map_costs& map : row.maps) {
            CHECK(map.facts.bytes > 0);
            CHECK(map.facts.build_ms > 0);
            CHECK(map.ns_per_pair > 0);
        }
        CHECK(row.triangles == std::size_t(some.count * 12 + 2));
        CHECK(row.pairs > pairs);
        pairs = row.pairs;
    }
}

TEST_CASE("coverage saves most of what prisms need where cubes are large and slow")
{
    const auto saved = [](const cube_case& some) {
        const moving_stage stage = renderer::random_cubes(1, some.count, 0.5f * some.speed, some.half_extent);
        return double(built("prism_ranges", {}, stage).building_bytes) /
               double(built("covered_prism_ranges", {}, stage).building_bytes);
    };
    CHECK(saved({400, 1.f / 32, 0.5f}) > 4);
    CHECK(saved({400, 8, 0.5f}) < 2);
}
