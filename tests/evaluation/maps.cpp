// Shadow maps of ranges, one kind against another: what each leaves out, or rounds, must not change what it promises.
#include "evaluation/motion/cube_curves.hpp"
#include "evaluation/motion/shadow_tests.hpp"
#include "passes/range/range_questions.hpp"
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
        // Rounding decides where fronts change.
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
    const moving_stage turning = renderer::cube_over_plane(1, 20, 2, 0);
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
    for (const moving_stage& stage : {cubes(), renderer::cube_over_plane(1, 20, 2, 0)}) {
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

TEST_CASE("kinds of maps take the memory that they say, in the order that they should")
{
    const auto& stage = cubes();
    const auto packed = compact_ranges(resolved_ranges(stage.world, stage.light, resolution));
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
    CHECK(packed.bodies == compact_ranges(resolved).bodies);
    const auto casters = caster_ranges(stage.world, stage.light, resolution);
    const auto packed_casters = compact_ranges(casters);
    CHECK(casters.bytes < resolved.bytes);
    CHECK(packed_casters.bytes < packed.bytes);
    CHECK(with_totals(casters).bytes == casters.bytes + 16 * (casters.first.size() - 1));
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
        const moving_stage stage = renderer::random_cubes(1, some.count, 0.5f * some.factor, some.half_extent);
        return double(prism_ranges(stage.world, stage.light, resolution).building_bytes) /
               double(covered_prism_ranges(stage.world, stage.light, resolution).building_bytes);
    };
    CHECK(saved({400, 1.f / 32, 0.5f}) > 4);
    CHECK(saved({400, 8, 0.5f}) < 2);
}
