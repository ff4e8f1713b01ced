// The motion of a layer against long double, motions that cancel, are hostile or far longer than the window; the grid of a
// layer against its defining equations.
#include "layer_cases.hpp"
#include "support/climber.hpp"
#include "support/effort.hpp"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <cstdint>

using namespace gnomon;
using namespace gnomon::test;

namespace {

/// A sample of a surface at the tile's centre with this depth, time and motion.
template <class T> stochastic_sample<T> moving_sample(double z, double t, double d_x, double d_y, double d_z)
{
    return {0, 0, T(t), T(z), T(d_x), T(d_y), T(d_z), 1};
}

template <class T> layer_motion<T> motion_of(const sample_list<T>& samples)
{
    layer_motion_sums<T> state = layer_motion_begin(samples.front());
    for (const auto& s : samples) state = layer_motion_add(state, s, layer_middle_depth(s));
    return layer_motion_end(state);
}

template <class T> layer_grid<T> grid_of(double d_x, double d_y, double d_z, double guard, double texels)
{
    return layer_grid_make(layer_motion<T>{T(d_x), T(d_y), T(d_z), 0, 0, T(-0.5), T(0.5)}, T(guard), T(texels));
}

/// The motion in long double, and the largest distance of a sample's motion from that of the first.
struct exact_motion {
    wide x = 0, y = 0, z = 0, square = 0, square_z = 0, farthest = 0, farthest_z = 0;
};

template <class T> exact_motion exactly(const sample_list<T>& samples)
{
    exact_motion r;
    const wide n = wide(samples.size());
    for (const auto& s : samples) r.x += wide(s.d_x) / n, r.y += wide(s.d_y) / n, r.z += wide(s.d_z) / n;
    for (const auto& s : samples) {
        const wide x = wide(s.d_x) - r.x, y = wide(s.d_y) - r.y, z = wide(s.d_z) - r.z;
        r.square += (x * x + y * y) / n, r.square_z += z * z / n;
        const auto& first = samples.front();
        r.farthest = std::max(r.farthest, std::hypot(wide(s.d_x) - wide(first.d_x), wide(s.d_y) - wide(first.d_y)));
        r.farthest_z = std::max(r.farthest_z, std::abs(wide(s.d_z) - wide(first.d_z)));
    }
    return r;
}

/// The largest error over its stated bound.
template <class T> double motion_error(const sample_list<T>& samples)
{
    const exact_motion exact = exactly(samples);
    const layer_motion<T> m = motion_of(samples);
    const wide n = wide(samples.size()), unit = wide(u<T>);
    const auto over = [](wide error, wide bound) { return error == 0 ? 0.0 : double(error / bound); };
    const wide x = std::abs(wide(m.d_x) - exact.x), y = std::abs(wide(m.d_y) - exact.y);
    const wide z = std::abs(wide(m.d_z) - exact.z);
    const wide square = std::abs(wide(m.spread) * wide(m.spread) - exact.square);
    const wide square_z = std::abs(wide(m.spread_z) * wide(m.spread_z) - exact.square_z);
    return std::max({over(x, unit * ((n + 3) * exact.farthest + std::abs(exact.x))),
                     over(y, unit * ((n + 3) * exact.farthest + std::abs(exact.y))),
                     over(z, unit * ((n + 3) * exact.farthest_z + std::abs(exact.z))),
                     over(square, unit * (n + 8) * exact.farthest * exact.farthest),
                     over(square_z, unit * (n + 8) * exact.farthest_z * exact.farthest_z)});
}

} // namespace

TEST_CASE_TEMPLATE("layer motion: mean and spread within the stated errors of long double", T, float, double)
{
    const auto score = [](const std::vector<double>& p) {
        sample_list<T> samples;
        const double scale = std::exp2(20 * p[0] - 10), drift = std::exp2(20 * p[1] - 10);
        for (std::size_t i = 2; i + 3 <= p.size(); i += 3)
            samples.push_back(
                moving_sample<T>(0, 0.5, drift + scale * (p[i] - 0.5), scale * (p[i + 1] - 0.5), p[i + 2] - 0.5));
        return motion_error(samples);
    };
    for (const std::size_t n : {2u, 5u, 16u}) {
        const summit worst = climb(2 + 3 * n, 40'000, 41 + n, score);
        CHECK(worst.score <= 1);
        CHECK(worst.score > 0.05);
    }
}

TEST_CASE_TEMPLATE("layer motion: samples of one motion have no spread; opposite ones cancel and have only spread", T,
                   float, double)
{
    const layer_motion<T> one = motion_of(sample_list<T>(7, moving_sample<T>(0.25, 0.3, 200.1, -77.7, 0.2)));
    CHECK((one.d_x == T(200.1) && one.d_y == T(-77.7) && one.d_z == T(0.2) && one.spread == 0 && one.spread_z == 0));
    CHECK(one.least == one.greatest);
    const layer_motion<T> opposite =
        motion_of(sample_list<T>{moving_sample<T>(0, 0.5, 40, 0, 0.5), moving_sample<T>(0.5, 0.5, -40, 0, -0.5)});
    CHECK((opposite.d_x == 0 && opposite.d_y == 0 && opposite.d_z == 0 && opposite.spread == 40 &&
           opposite.spread_z == T(0.5)));
    CHECK((opposite.least == T(-0.25) && opposite.greatest == T(0.75)));
    const layer_grid<T> still = layer_grid_make(opposite, T(12), T(8));
    CHECK((still.axis_x == 1 && still.axis_y == 0 && still.motion == 0 && still.scale_u == still.scale_v));
    const layer_motion<T> single = motion_of(sample_list<T>{moving_sample<T>(0.5, 0, 3, 4, 0)});
    CHECK((single.d_x == 3 && single.d_y == 4 && single.spread == 0 && single.least == T(0.5) &&
           single.greatest == T(0.5)));
}

TEST_CASE_TEMPLATE("layer motion: the background, NaN, infinities and motions beyond every map are no information", T,
                   float, double)
{
    const T inf = std::numeric_limits<T>::infinity(), nan = std::numeric_limits<T>::quiet_NaN();
    const layer_motion<T> none = motion_of(sample_list<T>{stochastic_background(T(1), T(2), T(0.5))});
    CHECK(
        (none.d_x == 0 && none.d_y == 0 && none.d_z == 0 && none.spread == 0 && none.least == 0 && none.greatest == 0));
    const stochastic_sample<T> good = moving_sample<T>(0.25, 0.5, 5, 6, 0.5);
    const layer_motion<T> alone = motion_of(sample_list<T>{good});
    for (const T bad : {inf, -inf, nan, T(1e9)}) {
        for (int member = 3; member < 7; ++member) {
            stochastic_sample<T> s = good;
            (member == 3 ? s.z : member == 4 ? s.d_x : member == 5 ? s.d_y : s.d_z) = bad;
            for (const layer_motion<T> m : {motion_of(sample_list<T>{s, good}), motion_of(sample_list<T>{good, s})})
                CHECK((m.d_x == alone.d_x && m.d_y == alone.d_y && m.d_z == alone.d_z && m.spread == alone.spread &&
                       m.least == alone.least && m.greatest == alone.greatest));
        }
    }
}

TEST_CASE_TEMPLATE("layer motion: all samples moved by the mean motion are between its least and greatest depth", T,
                   float, double)
{
    const auto property = [](std::uint64_t seed) {
        bit_source bits(seed);
        sample_list<T> samples;
        for (std::size_t n = 1 + bits.below(20); n > 0; --n)
            samples.push_back(moving_sample<T>(bits.uniform(-1, 1), bits.uniform(0, 1), 1, 2, bits.uniform(-1, 1)));
        const layer_motion<T> m = motion_of(samples);
        const layer_grid<T> grid = layer_grid_make(m, T(12), T(8));
        for (const auto& s : samples) {
            const T z = layer_grid_depth(grid, s.z, s.t);
            RC_ASSERT(z >= m.least - 8 * T(u<T>));
            RC_ASSERT(z <= m.greatest + 8 * T(u<T>));
            RC_ASSERT(std::abs(layer_grid_own_depth(grid, s.z, s.t)) <= 1 + 64 * T(u<T>));
        }
    };
    CHECK(rc::check("any depths, times and motions in depth", property));
    for (std::int64_t i = 0; i < effort(5'000); ++i) property(std::uint64_t(i));
}

TEST_CASE_TEMPLATE("layer grid: places within the stated error of Equation 6, for motions of any length", T, float,
                   double)
{
    const auto score = [](const std::vector<double>& p) {
        const double chord = std::exp2(26 * p[0] - 10), angle = 8 * p[1];
        const layer_grid<T> g = grid_of<T>(chord * std::cos(angle), chord * std::sin(angle), 0, 12, 8);
        const T x = T(12 * p[2] - 6), y = T(12 * p[3] - 6), t = T(p[4]);
        const wide d_x = wide(T(chord * std::cos(angle))), d_y = wide(T(chord * std::sin(angle))),
                   d = std::hypot(d_x, d_y);
        const wide s_v = 8.0L / 12, s_u = 8.0L / (12 + d);
        const wide exact_u = s_u * ((wide(x) * d_x + wide(y) * d_y) / d + d * (0.5L - wide(t))) + 4;
        const wide exact_v = s_v * (wide(y) * d_x - wide(x) * d_y) / d + 4;
        const layer_place<T> at = layer_grid_place(g, x, y, t);
        const wide across = std::abs(wide(x)) + std::abs(wide(y));
        const wide unit = 4 * wide(u<T>);
        return double(std::max(std::abs(wide(at.u) - exact_u) / (unit * (s_u * (across + d) + 8)),
                               std::abs(wide(at.v) - exact_v) / (unit * (s_v * across + 8))));
    };
    const summit worst = climb(5, 200'000, 46, score);
    CHECK(worst.score <= 1);
    CHECK(worst.score > 0.05);
}

TEST_CASE_TEMPLATE("layer grid: what moves with the layer stays in its place, and an unturned window stays inside", T,
                   float, double)
{
    bit_source bits(47);
    for (std::int64_t i = 0; i < effort(50'000); ++i) {
        const double chord = bits.chance(0.1) ? 0 : std::exp2(bits.uniform(-24, 15)), angle = bits.uniform(0, 7);
        const layer_grid<T> g = grid_of<T>(chord * std::cos(angle), chord * std::sin(angle), 0, 16, 16);
        const double x = bits.uniform(-8, 8), y = bits.uniform(-8, 8), t0 = bits.uniform(0, 1), t1 = bits.uniform(0, 1);
        const auto at = [&](double t) {
            const double moved = t - 0.5;
            return layer_grid_place(g, T(x + moved * chord * std::cos(angle)), T(y + moved * chord * std::sin(angle)),
                                    T(t));
        };
        const layer_place<T> a = at(t0), b = at(t1);
        const T brief = T(layer_least_motion); // shorter motions count as none
        REQUIRE(std::abs(a.u - b.u) <= 64 * T(u<T>) * 16 + brief);
        REQUIRE(std::abs(a.v - b.v) <= 64 * T(u<T>) * T(16 + chord) + brief);
        // Motion along an axis of the map leaves the window unturned: no sample falls off, at any time.
        const layer_grid<T> along =
            bits.chance(0.5) ? grid_of<T>(chord, 0, 0, 16, 16) : grid_of<T>(0, -chord, 0, 16, 16);
        const layer_place<T> inside = layer_grid_place(along, T(x * 0.999), T(y * 0.999), T(t0));
        REQUIRE(layer_place_is_inside(along, inside) == 1);
        REQUIRE((texel_below(inside.u) >= 0 && texel_below(inside.u) <= 15 && texel_below(inside.v) <= 15));
    }
    // Corners of a turned window fall off.
    const layer_grid<T> turned = grid_of<T>(1e-3, 1e-3, 0, 16, 16);
    CHECK(layer_place_is_inside(turned, layer_grid_place(turned, T(7.9), T(7.9), T(0.5))) == 0);
    CHECK(layer_place_is_inside(turned, layer_grid_place(turned, T(0), T(7.9), T(0.5))) == 1);
    const T nan = std::numeric_limits<T>::quiet_NaN();
    CHECK(layer_place_is_inside(turned, layer_grid_place(turned, nan, T(0), T(0.5))) == 0);
    CHECK(layer_place_is_inside(turned, layer_grid_place(turned, T(0), T(0), nan)) == 0);
    CHECK(layer_place_is_inside(grid_of<T>(1, 0, 0, double(nan), 8), layer_place<T>{nan, 1}) == 0);
}

TEST_CASE_TEMPLATE("layer grid: depths and own depths within the stated errors", T, float, double)
{
    const auto moved = [](const std::vector<double>& p) {
        const layer_grid<T> g = layer_grid_make(layer_motion<T>{0, 0, T(4 * p[0] - 2), 0, 0, -1, 1}, T(12), T(8));
        const T z = T(2 * p[1] - 1), t = T(p[2]);
        const wide exact = wide(z) + (0.5L - wide(t)) * wide(g.d_z);
        return double(std::abs(wide(layer_grid_depth(g, z, t)) - exact) /
                      (2 * wide(u<T>) * (std::abs(wide(z)) + std::abs(wide(g.d_z)))));
    };
    const summit of_depth = climb(3, 100'000, 49, moved);
    CHECK(of_depth.score <= 1);
    CHECK(of_depth.score > 0.25);
    const auto score = [](const std::vector<double>& p) {
        const layer_motion<T> m{0, 0, T(4 * p[0] - 2), 0, 0, T(2 * p[1] - 1), T(2 * p[1] - 1 + std::exp2(-12 * p[2]))};
        const layer_grid<T> g = layer_grid_make(m, T(12), T(8));
        const T z = T(2 * p[3] - 1), t = T(p[4]);
        const wide exact = (wide(z) + (0.5L - wide(t)) * wide(g.d_z) - wide(g.centre)) * wide(g.scale);
        const wide sizes = std::abs(wide(z)) + std::abs(wide(g.d_z)) + std::abs(wide(g.centre));
        return double(std::abs(wide(layer_grid_own_depth(g, z, t)) - exact) / (4 * wide(u<T>) * wide(g.scale) * sizes));
    };
    const summit worst = climb(5, 100'000, 48, score);
    CHECK(worst.score <= 1);
    CHECK(worst.score > 0.1);
}
