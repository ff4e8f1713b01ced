// Look-ups in a layer's grid: footprints and probes stay on the grid, move with the layer and have the mip level of their
// shorter axis; biases and least variances against long double; the filter across the motion; neighbours without a border.
#include "layer_cases.hpp"
#include "support/climber.hpp"
#include "support/effort.hpp"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <cstdint>

using namespace gnomon;
using namespace gnomon::test;

namespace {

template <class T> layer_grid<T> any_grid(bit_source& bits, double spread = 0)
{
    const double chord = bits.chance(0.2) ? 0 : std::exp2(bits.uniform(-4, 10)), angle = bits.uniform(0, 7);
    const layer_motion<T> m{T(chord * std::cos(angle)),
                            T(chord * std::sin(angle)),
                            T(bits.uniform(-0.5, 0.5)),
                            T(spread),
                            T(spread / 64),
                            T(-0.25),
                            T(0.25)};
    return layer_grid_make(m, T(12), T(8));
}

/// The footprint of a point at (x, y) at the middle of a time of 1/4, that moves by (m_x, m_y) over the shutter.
template <class T>
layer_footprint<T> footprint_of(const layer_grid<T>& g, T x, T y, T t, T m_x, T m_y, T cross_x, T cross_y,
                                T widening = 0)
{
    const T e = T(0.125);
    return layer_footprint_make(g, x - e * m_x, y - e * m_y, t - e, x + e * m_x, y + e * m_y, t + e, cross_x, cross_y,
                                widening);
}

} // namespace

TEST_CASE_TEMPLATE("layer footprint: all probes are on the grid, from 1 to 16, at a level of the chain", T, float,
                   double)
{
    const auto property = [](std::uint64_t seed) {
        bit_source bits(seed);
        const layer_grid<T> g = any_grid<T>(bits);
        const auto any = [&] { return T(std::exp2(bits.uniform(-6, 10)) * (bits.chance(0.5) ? 1 : -1)); };
        const layer_footprint<T> f = footprint_of(g, any(), any(), T(bits.uniform(0, 1)), any(), any(), any(), any());
        RC_ASSERT(f.probes >= 1);
        RC_ASSERT(f.probes <= 16);
        RC_ASSERT(f.probes == std::floor(f.probes));
        RC_ASSERT(f.level >= 0);
        for (T k = 0; k < f.probes; k += 1) {
            const layer_place<T> at = layer_probe(f, k);
            RC_ASSERT(layer_place_is_inside(g, at) == 1);
            RC_ASSERT(std::min(at.u, at.v) >= T(0.5) - 16 * T(u<T>));
            RC_ASSERT(std::max(at.u, at.v) <= T(7.5) + 16 * T(u<T>));
        }
        // Probes are no farther apart than the texels of their level are wide.
        const T apart = std::hypot(f.along_u, f.along_v) / f.probes;
        RC_ASSERT(apart <= std::exp2(f.level) * (1 + 64 * T(u<T>)));
    };
    CHECK(rc::check("any motions of grid and receiver", property));
    for (std::int64_t i = 0; i < effort(20'000); ++i) property(std::uint64_t(i));
}

TEST_CASE_TEMPLATE("layer footprint: what moves with the layer has no length; the second axis is the pixel's", T, float,
                   double)
{
    bit_source bits(61);
    for (std::int64_t i = 0; i < effort(20'000); ++i) {
        const layer_grid<T> g = any_grid<T>(bits);
        const T t = T(bits.uniform(0.2, 0.8)), along = g.motion;
        const T x = T(bits.uniform(-1, 1)) + (t - T(0.5)) * along * g.axis_x;
        const T y = T(bits.uniform(-1, 1)) + (t - T(0.5)) * along * g.axis_y;
        const layer_footprint<T> f = footprint_of(g, x, y, t, along * g.axis_x, along * g.axis_y, T(0), T(0));
        REQUIRE((f.probes == 1 && f.level == 0));
        REQUIRE(std::hypot(f.along_u, f.along_v) <= 64 * T(u<T>) * (8 + along));
        const layer_place<T> place = layer_grid_place(g, x, y, t);
        REQUIRE(std::abs(f.u - place.u) <= 64 * T(u<T>) * (8 + along));
        // A pixel across the motion: six texels of the map are four of the grid, by as many probes.
        const T width = T(6);
        const layer_footprint<T> wide_pixel = footprint_of(g, T(0), T(0), T(0.5), along * g.axis_x, along * g.axis_y,
                                                           -width * g.axis_y, width * g.axis_x);
        REQUIRE(std::abs(std::hypot(wide_pixel.along_u, wide_pixel.along_v) - 4) <= 64 * T(u<T>) * 4);
        REQUIRE((wide_pixel.probes >= 4 && wide_pixel.probes <= 5 && wide_pixel.level <= T(1e-5)));
        // Widened by the spread of motion, the shorter axis selects a coarser level, by fewer probes.
        const layer_footprint<T> widened = footprint_of(g, T(0), T(0), T(0.5), along * g.axis_x, along * g.axis_y,
                                                        -width * g.axis_y, width * g.axis_x, T(3));
        REQUIRE((std::abs(widened.level - 1) <= T(1e-5) && widened.probes >= 2 && widened.probes <= 3));
    }
    // A square pixel of 4 texels of the grid: one probe at level 2.
    const layer_grid<T> still = layer_grid_make(layer_motion<T>{0, 0, 0, 0, 0, -1, 1}, T(8), T(8));
    const layer_footprint<T> square =
        layer_footprint_make(still, T(-2), T(0), T(0), T(2), T(0), T(1), T(0), T(4), T(0));
    CHECK((square.probes == 1 && std::abs(square.level - 2) <= T(1e-5) && square.u == 4 && square.v == 4));
    // Beyond the map's border and far above the window: the ends are limited to the grid.
    const layer_footprint<T> far =
        layer_footprint_make(still, T(-1e6), T(900), T(0), T(1e6), T(900), T(1), T(0), T(0), T(0));
    CHECK((far.along_u == 7 && far.along_v == 0 && far.v == T(7.5) && far.probes == 7));
}

TEST_CASE_TEMPLATE("layer footprint: NaN stays NaN in the place, with one probe; any input has a level of the chain", T,
                   float, double)
{
    const T nan = std::numeric_limits<T>::quiet_NaN();
    bit_source bits(62);
    const layer_grid<T> g = any_grid<T>(bits);
    const layer_footprint<T> f = layer_footprint_make(g, nan, T(0), T(0), T(0), T(0), T(1), T(0), T(0), T(0));
    CHECK((std::isnan(f.u) && f.probes == 1 && f.level == 0));
    hostile_source<T> hostile(63);
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        const auto x = [&] { return bits.chance(0.5) ? hostile.special() : hostile.pattern(); };
        const layer_footprint<T> any = layer_footprint_make(g, x(), x(), x(), x(), x(), x(), x(), x(), x());
        REQUIRE((any.probes >= 1 && any.probes <= 16 && any.level >= 0 && any.level <= 3));
    }
}

TEST_CASE_TEMPLATE("layer bias: slope over texels of the grid, and what of the motion is not the layer's", T, float,
                   double)
{
    const auto score = [](const std::vector<double>& p) {
        bit_source bits(std::uint64_t(1e6 * p[0]));
        const layer_grid<T> g = any_grid<T>(bits, std::exp2(8 * p[1] - 4));
        const T along = T(0.01 * p[2]), across = T(0.01 * p[3]), t = T(p[4]);
        const wide off = wide(g.spread) * std::abs(0.5L - wide(t));
        const wide rise = wide(along) * (1.5L / wide(g.scale_u) + off) + wide(across) * (1.5L / wide(g.scale_v) + off);
        const wide exact = std::min<wide>(std::min<wide>(rise, 0.5L) + wide(g.spread_z) * std::abs(0.5L - wide(t)), 2);
        return double(std::abs(wide(layer_bias(g, along, across, t, T(1.5), T(0.5))) - exact) /
                      (8 * wide(u<T>) * exact));
    };
    const summit worst = climb(5, 100'000, 64, score);
    CHECK(worst.score <= 1);
    CHECK(worst.score > 0.1);

    // A level surface without spread needs none. Hostile numbers give a bias in [0, 2].
    bit_source bits(65);
    const layer_grid<T> level = any_grid<T>(bits);
    CHECK(layer_bias(level, T(0), T(0), T(0.1), T(1.5), T(2)) == 0);
    hostile_source<T> hostile(66);
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        layer_grid<T> g = any_grid<T>(bits, 1);
        g.spread = hostile.special(), g.spread_z = hostile.special(), g.scale_u = hostile.special();
        const T bias = layer_bias(g, hostile.pattern(), hostile.special(), hostile.special(), hostile.special(),
                                  hostile.special());
        REQUIRE((bias >= 0 && bias <= 2));
    }
    // Slopes turn with the grid and keep their length.
    for (std::int64_t i = 0; i < effort(10'000); ++i) {
        const layer_grid<T> g = any_grid<T>(bits);
        const depth_gradient<T> of{T(bits.uniform(-1, 1)), T(bits.uniform(-1, 1))}, slope = layer_slope(g, of);
        REQUIRE(std::abs(std::hypot(slope.x, slope.y) - std::hypot(of.x, of.y)) <= 8 * T(u<T>));
        REQUIRE(std::abs(slope.x - (of.x * g.axis_x + of.y * g.axis_y)) <=
                2 * T(u<T>) * (std::abs(of.x) + std::abs(of.y)));
    }
}

TEST_CASE_TEMPLATE("layer variance: at least that of places and depths off by the spread at a random time", T, float,
                   double)
{
    bit_source bits(67);
    for (std::int64_t i = 0; i < effort(10'000); ++i) {
        const layer_grid<T> g = any_grid<T>(bits, std::exp2(bits.uniform(-6, 4)));
        const T slope = T(bits.uniform(-0.02, 0.02)), least = T(1e-7);
        const wide spread = wide(g.spread), tilted = wide(slope) * spread;
        const wide exact = (wide(least) + (wide(g.spread_z) * wide(g.spread_z) + tilted * tilted) / 12) *
                           wide(g.scale) * wide(g.scale);
        REQUIRE(std::abs(wide(layer_minimum_variance(g, slope, least)) - exact) <= 8 * wide(u<T>) * exact);
        REQUIRE(layer_widening(g, T(0.25)) == g.spread / 4);
    }
}

TEST_CASE_TEMPLATE("layer tent: half of 0.05 (|d| - 2) texels, capped by the guard band; weights of a tent", T, float,
                   double)
{
    const auto radius = [](double motion) {
        return layer_tent_radius(layer_grid_make(layer_motion<T>{0, T(motion), 0, 0, 0, -1, 1}, T(12), T(8)), T(12),
                                 T(4));
    };
    CHECK(radius(0) == 0);
    CHECK(radius(2) == 0);
    CHECK(std::abs(radius(42) - T(2) / 3) <= 4 * T(u<T>));
    CHECK(std::abs(radius(1000) - T(8) / 3) <= 4 * T(u<T>)); // 4 texels of the map on either side
    CHECK(radius(std::numeric_limits<double>::quiet_NaN()) == 0);
    for (double motion = 0; motion < 300; motion += 0.5) CHECK(radius(motion) <= radius(motion + 0.5));
    for (const double r : {0.0, 0.5, 1.0, 1.5, 2.75}) {
        T sum = 0;
        for (int k = -4; k <= 4; ++k) {
            CHECK(layer_tent_weight(T(k), T(r)) == layer_tent_weight(T(-k), T(r)));
            CHECK((std::abs(k) < std::max(r, 1.0)) == (layer_tent_weight(T(k), T(r)) > 0));
            sum += layer_tent_weight(T(k), T(r));
        }
        CHECK((r > 1 || sum == 1));
        CHECK(layer_tent_weight(T(0), T(r)) == 1);
    }
}

TEST_CASE_TEMPLATE("layer neighbours: weights of four tiles are continuous across borders and sum to 1", T, float,
                   double)
{
    const auto weight = [](double x) { return layer_neighbour_at(T(x), T(4)).weight; };
    CHECK(weight(0) == 0);
    CHECK(weight(0.66) == 0);
    CHECK(std::abs(weight(2.0 / 3 + 2.0 / 3) - T(0.25)) <= 4 * T(u<T>)); // halfway between a third and the border
    CHECK(weight(2) == T(0.5));
    CHECK(weight(-2) == T(0.5));
    CHECK(weight(50) == T(0.5));
    CHECK(weight(std::numeric_limits<double>::quiet_NaN()) == 0);
    CHECK(layer_neighbour_at(T(-1.9), T(4)).towards == -1);
    CHECK(layer_neighbour_at(T(1.9), T(4)).towards == 1);
    // The share of each tile in a look-up changes by no more than 3/8 per texel, whichever tile looks up.
    const auto share_of_first = [&](double x) { // of the tile at [0, 4), seen from it and from that at [4, 8)
        const bool first = x < 4;
        const layer_neighbour<T> n = layer_neighbour_at(T(x - (first ? 2 : 6)), T(4));
        return double(first ? 1 - (n.towards > 0 ? n.weight : 0) : n.towards < 0 ? n.weight : T(0));
    };
    for (double x = 2; x < 6; x += 0x1p-6)
        CHECK(std::abs(share_of_first(x + 0x1p-6) - share_of_first(x)) <= 0x1p-6 * 0.375 + 4 * u<T>);
}
