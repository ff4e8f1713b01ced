// Degenerate parameters of kernels: 0, equal or swapped ends, the largest, negative and infinite numbers and NaN. Each row
// of the tables gives what a comment states. No parameter, whatever its bits, leaves [0, 1].
#include "support/effort.hpp"
#include "support/hostile.hpp"

#include <gnomon/filters/convolution.h>
#include <gnomon/filters/depth_bias.h>
#include <gnomon/filters/exponential.h>
#include <gnomon/filters/exponential_variance.h>
#include <gnomon/filters/layered_variance.h>
#include <gnomon/filters/percentage_closer.h>
#include <gnomon/filters/variance.h>
#include <gnomon/moments/bounds.h>
#include <gnomon/moments/hamburger4.h>
#include <gnomon/moments/two_point.h>
#include <gnomon/motion/receiver/shutter.h>
#include <gnomon/numerics/texel_filter.h>
#include <gnomon/storage/moments4_within.h>
#include <gnomon/storage/moments6.h>

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN(),
                 infinity = std::numeric_limits<double>::infinity();

/// A map of the single depth -1/2, before a receiver at 1/2 that it shadows, and one at -3/4 that it does not.
constexpr double caster = -0.5, behind = 0.5, before = -0.75;

/// A parameter and the intensities that it gives behind the caster and before it.
struct row {
    double parameter, behind, before;
};

/// Check intensity(parameter, receiver) by a table, and that any bits as a parameter give a number in [0, 1].
template <class T, class Intensity> void check(const char* name, const std::vector<row>& rows, Intensity intensity)
{
    CAPTURE(name);
    for (const row& r : rows) {
        CAPTURE(r.parameter);
        CHECK(double(intensity(T(r.parameter), T(behind))) == doctest::Approx(r.behind).epsilon(1e-3));
        CHECK(double(intensity(T(r.parameter), T(before))) == doctest::Approx(r.before).epsilon(1e-3));
    }
    hostile_source<T> hostile(1);
    for (std::int64_t i = 0; i < effort(20'000); ++i) {
        const T parameter = i % 2 == 0 ? hostile.pattern() : hostile.special();
        for (const double z_f : {behind, before}) {
            const T result = intensity(parameter, T(z_f));
            REQUIRE((0 <= result && result <= 1));
        }
    }
}

} // namespace

TEST_CASE_TEMPLATE("settings of filters", T, float, double)
{
    const T z = T(caster);
    check<T>("variance, minimum_variance",
             {{0, 1, 0}, {-1, 1, 0}, {1e-6, 1, 0}, {1, 0.5, 0}, {infinity, 0, 0}, {nan_value, 1, 0}},
             [=](T x, T z_f) { return variance_intensity(variance_encode(z), z_f, {x}); });
    check<T>("exponential, exponent",
             {{0, 0, 0},
              {1e-30, 0, 0},
              {40, 1, 0},
              {1e30, 1, 0},
              {infinity, 1, 0},
              {nan_value, 0, 0},
              {-1, 0, 1 - std::exp(-0.25)}}, // a negative one turns the order of depths around
             [=](T x, T z_f) {
                 const exponential_settings<T> s{x};
                 return exponential_intensity(exponential_encode(z, s), z_f, s);
             });
    check<T>("exponential variance, both exponents",
             {{0, 0, 0}, {1e-30, 0, 0}, {5.54, 1, 0}, {40, 1, 0}, {infinity, 0, 0}, {nan_value, 0, 0}},
             [=](T x, T z_f) {
                 const exponential_variance_settings<T> s{x, x, T(1e-9)};
                 return exponential_variance_intensity(exponential_variance_encode(z, s), z_f, s);
             });
    check<T>("exponential variance, one exponent: the other's bound stays",
             {{0, 1, 0}, {40, 1, 0}, {infinity, 1, 0}, {nan_value, 1, 0}}, [=](T x, T z_f) {
                 const exponential_variance_settings<T> s{x, T(5.54), T(1e-9)};
                 return exponential_variance_intensity(exponential_variance_encode(z, s), z_f, s);
             });
    check<T>("exponential variance, minimum_variance", {{0, 1, 0}, {-1, 1, 0}, {infinity, 0, 0}, {nan_value, 1, 0}},
             [=](T x, T z_f) {
                 const exponential_variance_settings<T> s{T(5.54), T(5.54), x};
                 return exponential_variance_intensity(exponential_variance_encode(z, s), z_f, s);
             });
    const auto layered = [=](T z_f, T centre, T scale, T minimum) {
        const layered_variance_settings<T> s{centre, scale, minimum};
        return layered_variance_end(
            layered_variance_add(layered_variance_begin(z_f), layered_variance_encode(z, s), s));
    };
    check<T>("layered variance, scale", {{0, 0, 0}, {1, 1, 0}, {1e30, 1, 0}, {infinity, 1, 0}, {nan_value, 0, 0}},
             [=](T x, T z_f) { return layered(z_f, T(0), x, T(0)); });
    check<T>("layered variance, centre",
             {{0, 1, 0}, {3, 0, 0}, {-3, 0, 0}, {infinity, 0, 0}, {-infinity, 0, 0}, {nan_value, 0, 0}},
             [=](T x, T z_f) { return layered(z_f, x, T(1), T(0)); });
    check<T>("layered variance, minimum_variance", {{0, 1, 0}, {-1, 1, 0}, {infinity, 0, 0}, {nan_value, 1, 0}},
             [=](T x, T z_f) { return layered(z_f, T(0), T(1), x); });
    const auto convolution = [=](T z_f, const convolution_settings<T>& s) {
        convolution_phase<T> phase = convolution_encode(z, s);
        convolution_sum<T> state = convolution_begin(z_f, s);
        for (int k = 1; k <= 4; ++k) {
            state = convolution_add(state, phase.cosine, phase.sine, convolution_weight(T(k), s));
            phase = convolution_next(phase);
        }
        return convolution_end(state);
    };
    // Without span, or damped altogether, the constant of the series is left.
    check<T>("convolution, span", {{0, 0.5, 0.5}, {nan_value, 0, 0}}, [=](T x, T z_f) {
        return convolution(z_f, {T(4), T(0), T(0), x});
    });
    check<T>("convolution, damping", {{1e30, 0.5, 0.5}, {infinity, 0.5, 0.5}, {nan_value, 0, 0}}, [=](T x, T z_f) {
        return convolution(z_f, {T(4), x, T(0), T(0.9375)});
    });
    check<T>("convolution, terms", {{nan_value, 0, 0}}, [=](T x, T z_f) {
        return convolution(z_f, {x, T(0), T(0), T(0.9375)});
    });
    check<T>("convolution, offset", {{nan_value, 0, 0}}, [=](T x, T z_f) {
        return convolution(z_f, {T(4), T(0), x, T(0.9375)});
    });
    check<T>(
        "percentage closer, weight",
        {{0, 0, 0}, {-1, 0, 0}, {0.25, 0.25, 0}, {infinity, 1, 0}, {-infinity, 0, 0}, {nan_value, 0, 0}},
        [=](T x, T z_f) { return percentage_closer_end(percentage_closer_add(percentage_closer_begin(z_f), z, x)); });
}

TEST_CASE_TEMPLATE("weights of biases, overestimation and over-darkening", T, float, double)
{
    const moments4<T> b = moments4_from_depth(T(caster));
    const moments6<T> c = moments6_from_depth(T(caster));
    const std::vector<row> biased{{0, 1, 0}, {1e-3, 0.999, 0}, {nan_value, 0, 0}};
    const T bias = T(0.4);
    check<T>("moments4_add_bias, alpha", biased, [=](T x, T z_f) {
        return hamburger4_lower(hankel4_from_moments(moments4_add_bias(b, bias, bias, x)), z_f);
    });
    check<T>("hankel4_constant_bias, alpha", biased,
             [=](T x, T z_f) { return hamburger4_lower(hankel4_constant_bias(b, bias, bias, x), z_f); });
    check<T>("theta4_inverse_add_bias, alpha", biased, [=](T x, T z_f) {
        return hamburger4_lower(hankel4_from_moments(theta4_inverse_add_bias(theta4(b), bias, x)), z_f);
    });
    check<T>("moments6_add_bias, alpha", biased, [=](T x, T z_f) {
        return hamburger6_lower(hankel6_from_moments(moments6_add_bias(c, bias, T(0.3), T(0.25), x)), z_f);
    });
    check<T>("hankel6_constant_bias, alpha", biased,
             [=](T x, T z_f) { return hamburger6_lower(hankel6_constant_bias(c, bias, T(0.3), T(0.25), x), z_f); });
    check<T>("certified4_constant_bias_lower, alpha", {{1e-3, 0.999, 0}, {nan_value, 0, 0}}, [=](T x, T z_f) {
        return certified4_constant_bias_lower(hankel4_constant_bias(b, bias, bias, x), moments4<T>{}, bias, bias, x,
                                              z_f);
    });
    check<T>("certified4_theta_lower, noise", {{0, 1, 0}, {infinity, 0, 0}, {nan_value, 0, 0}},
             [=](T x, T z_f) { return certified4_theta_lower(hankel4_from_unorm16(theta4(b)), theta4(b), x, z_f); });
    check<T>("bounds_intensity, overestimation: clamped, NaN counts as 0",
             {{0, 0.75, 0.75},
              {1, 0.25, 0.25},
              {-1, 0.75, 0.75},
              {2, 0.25, 0.25},
              {infinity, 0.25, 0.25},
              {-infinity, 0.75, 0.75},
              {nan_value, 0.75, 0.75}},
             [=](T x, T) {
                 return bounds_intensity(hamburger_bounds<T>{T(0.25), T(0.75), T(0.5)}, x);
             });
    check<T>(
        "over_darken, strength",
        {{1, 0.5, 0}, {0.98, 0.5 / 0.98, 0}, {0, 1, 0}, {2, 0.25, 0}, {-1, 0, 0}, {infinity, 0, 0}, {nan_value, 0, 0}},
        [=](T x, T z_f) { return over_darken(T(z_f > 0 ? 0.5 : 0), x); });
    for (const double least : {-1.0, 0.0, nan_value, infinity, -infinity}) {
        const distribution2<T> d = two_point_distribution(T(0.1), T(0.5), T(0.05), T(least));
        CHECK(std::isfinite(d.depth1 + d.depth2 + d.weight1 + d.weight2));
        CHECK((least == infinity) == (d.weight2 == 0)); // no variance is above it: a single depth
    }
}

// Where the ends say nothing, swapped or NaN, the receiver is lit.
TEST_CASE_TEMPLATE("ends of depth intervals", T, float, double)
{
    struct ends {
        double least, greatest, behind, before;
    };
    const channels4<T> unorm = moments4_unorm16_encode(T(caster)), half = moments4_half_encode(T(caster));
    for (const ends& e : {ends{-1, 1, 1, 0},
                          {-0.5, -0.5, 1, 0},
                          {-0.5, 1, 1, 0},
                          {-infinity, infinity, 1, 0},
                          {-1e30, 1e30, 1, 0},
                          {1, -1, 0, 0},
                          {0.75, -0.75, 0, 0},
                          {0, -0.8, 0, 0},
                          {nan_value, 1, 0, 0},
                          {-1, nan_value, 0, 0},
                          {nan_value, -0.6, 0, 0},
                          {nan_value, nan_value, 0, 0}}) {
        CAPTURE(e.least);
        CAPTURE(e.greatest);
        const T least = T(e.least), greatest = T(e.greatest);
        for (const auto& [z_f, truth] : {std::pair{T(behind), e.behind}, {T(before), e.before}}) {
            for (const T intensity : {moments4_unorm16_intensity_within(unorm, least, greatest, z_f),
                                      moments4_unorm16_filtered_intensity_within(unorm, least, greatest, z_f),
                                      moments4_half_intensity_within(half, least, greatest, z_f),
                                      moments4_half_filtered_intensity_within(half, least, greatest, z_f)})
                CHECK(std::abs(double(intensity) - truth) <= 0.03);
        }
    }
}

TEST_CASE_TEMPLATE("planes of depth converters: what they give is stored as a depth or as the far plane", T, float,
                   double)
{
    struct planes {
        double near, far;
    };
    for (const planes& p : {planes{3, 3},
                            {0, 3},
                            {3, 0},
                            {5, 2},
                            {0, 0},
                            {-1, 2},
                            {1, infinity},
                            {infinity, infinity},
                            {1e-40, 1e38},
                            {nan_value, 3},
                            {3, nan_value},
                            {-infinity, infinity}})
        for (const double z : {0.0, 0.5, 1.0, 3.0, -1.0, infinity, -infinity, nan_value}) {
            const T n = T(p.near), f = T(p.far);
            for (const T depth :
                 {depth_from_distance(T(z), n, f), depth_from_perspective(T(z), n, f),
                  depth_from_reversed_perspective(T(z), n, f), depth_from_infinite(T(z), n, f),
                  depth_from_reversed_infinite(T(z), n, f), depth_from_unit(T(z)), depth_from_reversed(T(z))}) {
                const T stored = moments4_float_encode(depth).c1;
                CHECK((-1 <= stored && stored <= 1));
                CHECK((stored == 1 || !std::isnan(depth)));
            }
        }
    const auto stored = [](T depth) { return moments4_float_encode(depth).c1; };
    CHECK(stored(depth_from_distance(T(2), T(3), T(3))) == -1); // equal planes: before them, on them, behind them
    CHECK(stored(depth_from_distance(T(3), T(3), T(3))) == 1);
    CHECK(stored(depth_from_distance(T(4), T(3), T(3))) == 1);
    CHECK(depth_from_perspective(T(0.25), T(3), T(3)) == T(-0.5)); // equal planes: a linear buffer
    CHECK(depth_from_perspective(T(0.25), T(0), T(3)) == -1);      // the buffer of a near plane at 0 holds no depth
}

TEST_CASE_TEMPLATE("depth biases, filter weights and shutters", T, float, double)
{
    const T nan = T(nan_value), inf = T(infinity);
    const auto slope = [](T across, T along, T rise, T steepest) {
        return depth_bias_slope_scaled(across, along, rise, steepest);
    };
    CHECK(slope(1, 0, T(0.25), 4) == 1);   // a plane along the light: the steepest slope
    CHECK(slope(0, 0, T(0.25), 4) == 0);   // no normal
    CHECK(slope(1, 0, T(0.25), inf) == 2); // the whole range of depth
    CHECK(slope(1, 1, T(0.25), 0) == 0);
    CHECK(slope(1, 1, T(0.25), -1) == 0);
    CHECK(slope(1, 1, T(0.25), nan) == T(0.25)); // no steepest slope
    CHECK(slope(1, 1, -1, 4) == 0);
    CHECK(slope(1, 1, inf, 4) == 2);
    const auto parallel = depth_gradient_from_derivatives(T(1), T(2), T(0.5), T(2), T(4), T(0.25)); // determinant 0
    CHECK(depth_bias_receiver_plane(parallel, T(1), T(1), T(0.125)) == T(0.125));
    const auto still = depth_gradient_from_derivatives(T(0), T(0), T(0), T(0), T(0), T(0));
    CHECK(depth_bias_receiver_plane(still, T(1), T(1), T(0.125)) == 0);
    const depth_gradient<T> one{1, 0};
    CHECK(depth_bias_receiver_plane(one, T(0.5), T(1), T(-1)) == 0);
    CHECK(depth_bias_receiver_plane(one, T(0.5), T(1), nan) == T(0.5)); // no limit
    CHECK(depth_bias_receiver_plane(one, inf, T(1), inf) == 2);
    for (const double look_ups : {0.0, -1.0, 0.5, infinity, -infinity, nan_value})
        for (const double i : {0.0, 1.0, 7.0, -1.0, nan_value}) {
            const T weight = texel_weight(T(0.25), T(i), T(look_ups));
            CHECK((0 <= weight && weight <= 1));
        }
    CHECK(texel_weight(T(0.25), T(0), T(0)) == 1); // no look-up: the texel itself
    // An exposure of no length: none of its light before, all after.
    for (const auto& share :
         {+[](T t, T a, T b) { return shutter_box(t, a, b); }, +[](T t, T a, T b) { return shutter_tent(t, a, b); }}) {
        CHECK(share(T(0.25), T(0.5), T(0.5)) == 0);
        CHECK(share(T(0.5), T(0.5), T(0.5)) == 0);
        CHECK(share(T(0.75), T(0.5), T(0.5)) == 1);
        CHECK(share(nan, T(0), T(1)) == 0);
    }
}
