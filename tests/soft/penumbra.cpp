// Penumbrae: the width of the shadow's border by its geometry, hard at the contact and linear in the distance.
#include "support/effort.hpp"
#include "support/hostile.hpp"
#include "support/rounding.hpp"

#include <gnomon/filters/depth_bias.h>
#include <gnomon/moments/bounds.h>
#include <gnomon/moments/depth.h>
#include <gnomon/passes/summed_area.hpp>
#include <gnomon/soft/penumbra.h>
#include <gnomon/storage/moments4_summed.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

TEST_CASE_TEMPLATE("widths are in [1, widest] for any input, and 1 for a NaN", T, float, double)
{
    hostile_source<T> source(1);
    for (std::int64_t i = 0; i < effort(200'000); ++i) {
        const auto x = source.draw();
        const T directional = penumbra_directional(x[0], x[1], x[2], x[3]);
        const T local = penumbra_local(x[0], x[1], x[2], x[3], x[4], x[5]);
        for (const auto& [width, widest] : {std::pair{directional, x[3]}, {local, x[5]}}) {
            REQUIRE(width >= 1);
            REQUIRE((std::isnan(widest) || width <= std::max(T(1), widest)));
        }
        if (std::isnan(x[0]) || std::isnan(x[1])) REQUIRE((directional == 1 && local == 1));
    }
}

TEST_CASE_TEMPLATE("widths have at most their stated errors", T, float, double)
{
    using exact = long double;
    bit_source bits(2);
    double directional = 0, local = 0, scale = 0;
    for (std::int64_t i = 0; i < effort(200'000); ++i) {
        const T z_b = T(bits.uniform(-1, 1)), z_f = T(bits.uniform(double(z_b), 1));
        const T tangent = T(bits.uniform(0.001, 0.5)), range = T(bits.uniform(1, 100)),
                texels = T(bits.uniform(1, 1000));
        const T per_depth = penumbra_texels_per_depth(tangent, range, texels);
        const auto relative = [](T value, exact want) { return std::abs(double(exact(value) / want - 1)) / u<T>; };
        scale = std::max(scale, relative(per_depth, exact(tangent) * exact(range) * exact(texels)));
        const exact want = (exact(z_f) - exact(z_b)) * exact(per_depth);
        if (want > 1)
            directional = std::max(directional, relative(penumbra_directional(z_f, z_b, per_depth, T(1e9)), want));
        const T near_distance = T(bits.uniform(0.1, 2)), far_distance = near_distance + range;
        const auto distance = [&](T z) {
            return exact(near_distance) + (exact(far_distance) - exact(near_distance)) * (exact(z) + 1) / 2;
        };
        const exact seen = exact(texels) * (1 / distance(z_b) - 1 / distance(z_f));
        if (seen > 1)
            local =
                std::max(local, relative(penumbra_local(z_f, z_b, near_distance, far_distance, texels, T(1e9)), seen));
    }
    CHECK(scale <= 2);
    CHECK(directional <= 2);
    CHECK(local <= 10);
    if (!draws_few()) CHECK((directional > 0.9 && local > 1.5)); // the measure sees errors
}

TEST_CASE("the search for blockers is as wide as the penumbra of a blocker at the near plane, and both end at widest")
{
    CHECK(penumbra_directional(1.0f, -1.0f, 10.0f, 1e9f) == 20);
    CHECK(penumbra_directional(1.0f, -1.0f, 10.0f, 15.0f) == 15);
    CHECK(penumbra_directional(0.5f, 0.7f, 10.0f, 15.0f) == 1);
    CHECK(penumbra_directional(-1.0f, -1.0f, 10.0f, 15.0f) == 1);
    CHECK(penumbra_local(1.0f, -1.0f, 1.0f, 4.0f, 40.0f, 1e9f) == 30); // 40 (1 / 1 - 1 / 4)
    CHECK(penumbra_local(1.0f, -1.0f, 0.0f, 4.0f, 40.0f, 27.0f) == 27);
    CHECK(penumbra_local(-1.0f, 1.0f, 1.0f, 4.0f, 40.0f, 27.0f) == 1);
}

namespace {

/// A half plane at depth z_b over a ground: the shadow on receivers at depth z_f along a row of the map.
class edge_over_ground {
  public:
    using table = moments4_summed;
    static constexpr std::size_t size = 256, most = 28 * 28;
    static constexpr float widest = 27, texels_per_depth = 60;

    edge_over_ground(float z_b, float ground) : ground_(ground), texels_(size * size)
    {
        std::vector<std::array<float, 4>> depths(size * size, {ground, ground, ground, ground});
        for (std::size_t y = 0; y < size; ++y)
            for (std::size_t x = 0; x < size / 2; ++x) depths[y * size + x].fill(z_b);
        build_summed_area<table>(map_view<const std::array<float, 4>>{depths, size, size},
                                 map_view<table::texel>{texels_, size, size}, most);
    }
    [[nodiscard]] float shadow(float x) const
    {
        const map_view<const table::texel> map{texels_, size, size};
        const float y = 100.3f;
        const float search = penumbra_directional(ground_, -1.0f, texels_per_depth, widest);
        const auto searched = grid_average<table>(map, most, summed_area_around(x, y, search, search));
        const float z_b = table::blocker(searched, most, ground_);
        const float width = penumbra_directional(ground_, z_b, texels_per_depth, widest);
        return table::intensity(rectangle_average<table>(map, most, summed_area_around(x, y, width, width)), most,
                                ground_);
    }
    /// The distance between receivers of 10% and of 90% shadow, which is 0.8 of the penumbra.
    [[nodiscard]] double border() const
    {
        const auto at = [&](float level) {
            float low = 128 + 40, high = 128 - 40; // the shadow grows to the left
            for (int i = 0; i < 40; ++i) {
                const float middle = 0.5f * (low + high);
                (shadow(middle) < level ? low : high) = middle;
            }
            return double(low);
        };
        return at(0.1f) - at(0.9f);
    }

  private:
    float ground_;
    std::vector<table::texel> texels_;
};

} // namespace

TEST_CASE("contact hardens: the border of a slab's shadow grows linearly with its distance, within 5% and a texel")
{
    const float ground = 0.4f;
    double last = 0;
    for (const float distance : {0.01f, 0.1f, 0.15f, 0.2f, 0.25f, 0.3f, 0.4f}) {
        const double want = 0.8 * std::max(1.0, double(distance) * double(edge_over_ground::texels_per_depth));
        const double border = edge_over_ground(ground - distance, ground).border();
        CHECK_MESSAGE(std::abs(border - want) <= 0.05 * want + 1, distance << ": " << border << " of " << want);
        CHECK(border >= last);
        last = border;
    }
}

TEST_CASE("in the umbra the filter may be skipped without a step")
{
    for (const float epsilon : {0.01f, 0.05f})
        for (float lower = 1; lower > 0.9f; lower -= 0.001f) {
            const float shown = over_darken(lower, 1 - epsilon);
            if (lower > 1 - epsilon) CHECK(shown == 1);
            else CHECK(shown == doctest::Approx(double(lower / (1 - epsilon))).epsilon(1e-6));
        }
}

TEST_CASE_TEMPLATE("a texel's own bias is what the plane rises to its centre, and the largest is that of the rectangle",
                   T, float, double)
{
    bit_source bits(3);
    double worst = 0;
    for (std::int64_t i = 0; i < effort(20'000); ++i) {
        const depth_gradient<T> slope{T(bits.uniform(-0.1, 0.1)), T(bits.uniform(-0.1, 0.1))};
        const T epsilon = T(bits.uniform(0, 0.01));
        T largest = 0;
        for (int y = -3; y <= 3; ++y)
            for (int x = -3; x <= 3; ++x) {
                const T bias = depth_bias_texel_plane(slope, T(x), T(y), T(2), epsilon);
                const double rise = double(slope.x) * x + double(slope.y) * y;
                const double sum = std::abs(double(slope.x) * x) + std::abs(double(slope.y) * y) + double(epsilon);
                worst = std::max(worst, std::abs(double(bias) - (std::max(0.0, rise) + double(epsilon))) / sum / u<T>);
                largest = std::max(largest, bias);
            }
        const T whole = depth_bias_receiver_plane(slope, T(3), T(3), T(2));
        REQUIRE(std::abs(largest - (whole + epsilon)) <= T(8) * T(u<T>));
    }
    CHECK(worst <= 4);
    hostile_source<T> source(4);
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        const auto x = source.draw();
        const T bias = depth_bias_texel_plane(depth_gradient<T>{x[0], x[1]}, x[2], x[3], x[4], x[5]);
        REQUIRE((0 <= bias && bias <= 2));
    }
}

TEST_CASE("a plane is not in its own shadow, with the bias for the half widths of its filter")
{
    // 80 degrees: 5.67 units of depth per unit of length, of a filter of up to 27 texels.
    const depth_gradient<double> slope{0.01, -0.02};
    for (const double width : {1.0, 9.0, 27.0}) {
        const double bias = depth_bias_receiver_plane(slope, width / 2, width / 2, 2.0);
        CHECK(bias == doctest::Approx(0.015 * width));
        for (const double x : {-width / 2, width / 2})
            for (const double y : {-width / 2, width / 2}) CHECK(slope.x * x + slope.y * y >= -bias - 1e-12);
    }
}
