// A layer divided by motion: directions against Eigen, and bars that pass one another at one depth against their covered times.
#include "layer_cases.hpp"
#include "support/climber.hpp"
#include "support/effort.hpp"

#include <gnomon/motion/layers/layer_parts.h>

#include <Eigen/Eigenvalues>
#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <cstdint>

using namespace gnomon;
using namespace gnomon::test;

namespace {

template <class T> layer_motion<T> mean_motion(const sample_list<T>& samples)
{
    layer_motion_sums<T> state = layer_motion_begin(samples.front());
    for (const auto& s : samples) state = layer_motion_add(state, s, layer_middle_depth(s));
    return layer_motion_end(state);
}

template <class T> layer_direction<T> direction_of(const sample_list<T>& samples)
{
    layer_direction_sums<T> state = layer_direction_begin(mean_motion(samples));
    for (const auto& s : samples) state = layer_direction_add(state, s, layer_middle_depth(s));
    return layer_direction_end(state);
}

template <class T> T part_cut(const sample_list<T>& samples, T bins)
{
    const layer_direction<T> direction = direction_of(samples);
    std::vector<T> keys;
    for (const auto& s : samples) keys.push_back(layer_direction_key(direction, s));
    const layer_window<T> window = window_of(keys);
    layer_runs<T> runs = layer_cuts_begin(window);
    for (const bool occupied : occupied_bins(keys, window)) runs = layer_cuts_add(runs, T(occupied));
    return layer_part_cut(runs, bins);
}

/// Two bars of half width 1.5 at one depth that pass one another along x, each by 12 texels, seen from x = -8 to 8.
struct bars {
    static double place(int bar, double t) { return bar == 0 ? -6 + 12 * t : 6 - 12 * t; }
    static bool covers(int bar, double x, double t) { return std::abs(x - place(bar, t)) < 1.5; }
    static bool is_near_edge(int bar, double x, double t) { return std::abs(std::abs(x - place(bar, t)) - 1.5) < 0.9; }
    template <class T> static stochastic_sample<T> seen(double x, double y, double t)
    {
        for (const int bar : {0, 1})
            if (covers(bar, x, t)) return {T(x), T(y), T(t), T(0.25), T(bar == 0 ? 12 : -12), 0, 0, T(bar)};
        return stochastic_background(T(x), T(y), T(t));
    }
};

constexpr std::size_t grid_extent = 32;

/// The visibility of a receiver behind the bars through a grid of all samples, or of one part of them.
template <class T> struct part_map {
    layer_grid<T> grid;
    std::vector<layer_sums<T>> texels = std::vector<layer_sums<T>>(grid_extent * grid_extent);

    T visibility(double x, double y, double t) const
    {
        const layer_place<T> at = layer_grid_place(grid, T(x), T(y), T(t));
        const std::size_t u = std::size_t(texel_below(at.u)), v = std::size_t(texel_below(at.v));
        return layer_visibility(texels[v * grid_extent + u], layer_grid_own_depth(grid, T(0.9), T(t)), T(1e-6));
    }
};

template <class T> part_map<T> part_of(const sample_list<T>& samples, auto is_in)
{
    sample_list<T> own;
    for (const auto& s : samples)
        if (is_in(s)) own.push_back(s);
    part_map<T> map{layer_grid_make(mean_motion(own), T(16), T(grid_extent))};
    for (const auto& s : samples) {
        const layer_place<T> at = layer_grid_place(map.grid, s.x, s.y, s.t);
        if (layer_place_is_inside(map.grid, at) == 0) continue;
        layer_sums<T>& texel =
            map.texels[std::size_t(texel_below(at.v)) * grid_extent + std::size_t(texel_below(at.u))];
        const T layer =
            layer_of(layer_middle_depth(s), layer_cuts<T>{T(layer_no_cut), T(layer_no_cut), T(layer_no_cut)});
        texel = layer_sums_add(texel, layer_grid_own_depth(map.grid, s.z, s.t),
                               layer_share_of_part(layer, T(0), T(is_in(s)), T(1), s.z, T(0.25)));
    }
    return map;
}

} // namespace

TEST_CASE_TEMPLATE("layer parts: the direction is the main axis of the motions' covariance, as by Eigen", T, float,
                   double)
{
    const auto property = [](std::uint64_t seed) {
        bit_source bits(seed);
        sample_list<T> samples;
        const double turn = bits.uniform(0, 7), longer = std::exp2(bits.uniform(-4, 8)), ratio = bits.uniform(0, 0.7);
        for (std::size_t n = 2 + bits.below(20); n > 0; --n) {
            const double a = longer * bits.uniform(-1, 1), b = ratio * longer * bits.uniform(-1, 1);
            samples.push_back({0, 0, T(0.5), 0, T(3 + a * std::cos(turn) - b * std::sin(turn)),
                               T(a * std::sin(turn) + b * std::cos(turn) - 7), 0, 1});
        }
        const layer_motion<T> mean = mean_motion(samples);
        Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
        for (const auto& s : samples) {
            const Eigen::Vector2d d(double(s.d_x) - double(mean.d_x), double(s.d_y) - double(mean.d_y));
            covariance += d * d.transpose() / double(samples.size());
        }
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(covariance);
        const double larger = solver.eigenvalues()[1], apart = larger - solver.eigenvalues()[0];
        const layer_direction<T> direction = direction_of(samples);
        const Eigen::Vector2d axis(double(direction.axis_x), double(direction.axis_y));
        const double rounding = (16 + double(samples.size())) * u<T> + 1e-13;
        RC_ASSERT(std::abs(axis.norm() - 1) <= 4 * u<T>);
        const double off =
            std::abs(axis.x() * solver.eigenvectors().col(1).y() - axis.y() * solver.eigenvectors().col(1).x());
        RC_ASSERT(off <= rounding * larger / apart);
        RC_ASSERT(std::abs(double(direction.scale) * 4 * std::sqrt(larger) - 1) <= rounding);
    };
    CHECK(rc::check("any motions", property));
    for (std::int64_t i = 0; i < effort(20'000); ++i) property(std::uint64_t(i));
}

TEST_CASE_TEMPLATE("layer parts: one motion is one part; opposite ones are two, outliers and NaN are no part", T, float,
                   double)
{
    const T nan = std::numeric_limits<T>::quiet_NaN();
    const auto moving = [](double x, double y) { return stochastic_sample<T>{0, 0, T(0.5), 0, T(x), T(y), 0, 1}; };
    CHECK(part_cut(sample_list<T>(9, moving(40, -3)), T(1)) == T(layer_no_cut));
    CHECK(direction_of(sample_list<T>(9, moving(40, -3))).scale == 0);
    const sample_list<T> opposite{moving(0, 10), moving(0, -10), moving(0.1, 10), moving(0, -10.1)};
    const T cut = part_cut(opposite, T(8));
    CHECK(std::abs(cut) < T(0.2));
    CHECK(std::abs(direction_of(opposite).axis_y) > T(0.999));
    CHECK(part_cut(opposite, T(63)) == T(layer_no_cut));
    CHECK(part_cut(opposite, nan) == T(layer_no_cut));
    CHECK(layer_direction_key(direction_of(opposite), moving(0, double(nan))) == T(layer_unknown_depth));
    CHECK(std::abs(layer_direction_key(direction_of(opposite), moving(0, 60000))) == T(layer_depth_limit));
    sample_list<T> with_nan = opposite;
    with_nan.push_back(moving(double(nan), 0)), with_nan.push_back(stochastic_background(T(0), T(0), T(0)));
    CHECK(direction_of(with_nan).scale == direction_of(opposite).scale);
    const auto share = [](T at, T part, T middle) { return layer_share_of_part(at, T(1), part, T(1), middle, T(0.5)); };
    for (const T middle : {T(0.5), T(0.6)}) {
        CHECK(share(1, 0, middle).opacity == 0);
        CHECK(share(1, 0, middle).weight == T(middle > T(0.5)));
        CHECK(share(2, 0, middle).weight == 1);
        CHECK(share(0, 1, middle).weight == 0);
        CHECK(share(1, 1, middle).opacity == 1);
        CHECK(share(1, 1, middle).weight == 1);
        CHECK(share(1, nan, middle).weight == 0);
        CHECK(share(1, -1, middle).weight == 0);
        CHECK(share(nan, 0, middle).weight == 0);
    }
    CHECK(share(1, 0, nan).weight == 0);
}

TEST_CASE_TEMPLATE("layer parts: bars that pass one another shadow by their times; as one layer they do not", T, float,
                   double)
{
    bit_source bits(71);
    sample_list<T> samples;
    for (int i = 0; i < 64 * 256; ++i)
        samples.push_back(bars::seen<T>(bits.uniform(-8, 8), bits.uniform(-8, 8), bits.uniform(0, 1)));
    sample_list<T> surfaces;
    for (const auto& s : samples)
        if (s.id >= 0) surfaces.push_back(s);
    const layer_motion<T> mean = mean_motion(surfaces);
    CHECK((std::abs(mean.d_x) < 1 && mean.spread > 11));
    const layer_direction<T> direction = direction_of(surfaces);
    const T cut = part_cut(surfaces, T(16));
    REQUIRE(cut < T(layer_no_cut));
    const auto first = [&](const stochastic_sample<T>& s) {
        return s.id >= 0 && layer_direction_key(direction, s) < cut;
    };
    const auto second = [&](const stochastic_sample<T>& s) {
        return s.id >= 0 && !(layer_direction_key(direction, s) < cut);
    };
    const part_map<T> all = part_of(samples, [](const stochastic_sample<T>& s) { return s.id >= 0; });
    const part_map<T> a = part_of(samples, first), b = part_of(samples, second);
    double squares_of_one = 0, squares_of_two = 0, shadow = 0, covered = 0;
    int receivers = 0;
    for (int i = 0; i < 8000; ++i) {
        const double x = bits.uniform(-4, 4), y = bits.uniform(-4, 4), t = bits.uniform(0, 1);
        if (bars::is_near_edge(0, x, t) || bars::is_near_edge(1, x, t)) continue; // within a texel of the grid
        const double exact = bars::covers(0, x, t) || bars::covers(1, x, t);
        const double one = 1 - double(all.visibility(x, y, t));
        const double two = 1 - double(a.visibility(x, y, t) * b.visibility(x, y, t));
        squares_of_one += (one - exact) * (one - exact), squares_of_two += (two - exact) * (two - exact), ++receivers;
        shadow += two, covered += exact;
    }
    CHECK(receivers > 1000);
    CHECK(std::sqrt(squares_of_one / receivers) > 0.4); // half of the light at nearly all times
    CHECK(std::sqrt(squares_of_two / receivers) < 0.01);
    CHECK(std::abs(shadow - covered) / receivers < 0.01);
}
