// Phase functions, transmittance, radiance and overestimation against integrals, and the signs of their directions.
#include "climbed.hpp"

#include <gnomon/moments/bounds.h>
#include <gnomon/scattering/height_fog.h>
#include <gnomon/scattering/rectified.h>
#include <gnomon/scattering/single_scattering.h>

using namespace gnomon;
using namespace gnomon::test;

namespace {

constexpr double pi = 3.14159265358979324;
constexpr std::int64_t evaluations = 200'000;

/// (1 - e^(-rate length)) / rate.
template <class Length, class Rate> wide length_of(Length length, Rate rate)
{
    return rate == 0 ? wide(length) : -std::expm1(-wide(rate) * wide(length)) / wide(rate);
}

/// The integral of f over [a, b] by Simpson's rule.
template <class F> double integral(double a, double b, int pieces, F f)
{
    const double h = (b - a) / pieces;
    double sum = 0;
    for (int i = 0; i < pieces; ++i) sum += f(a + i * h) + 4 * f(a + (i + 0.5) * h) + f(a + (i + 1) * h);
    return sum * h / 6;
}

} // namespace

TEST_CASE_TEMPLATE("the mean transmittance has its stated error for every optical depth, without cancellation", T,
                   float, double)
{
    check_error(3.5, 1, evaluations, [](const place& p) {
        const T x = magnitude<T>(p[0], 20);
        return ulps(attenuated_mean(x), length_of(1, x));
    });
    check_error(4.5, 2, evaluations, [](const place& p) {
        const T length = magnitude<T>(p[0], 20), rate = magnitude<T>(p[1], 20);
        return ulps(attenuated_length(length, rate), length_of(length, rate));
    });
    check_error(is_float<T> ? 1 : 1.2, 1, evaluations, [](const place& p) {
        const T x = T(p[0] * (is_float<T> ? 87 : 708));
        return ulps(transmittance_over(x), std::exp(-wide(x)));
    });
}

TEST_CASE_TEMPLATE("lengths and transmittances have their limits at 0, infinity and NaN", T, float, double)
{
    constexpr T infinite = std::numeric_limits<T>::infinity(), nan = std::numeric_limits<T>::quiet_NaN();
    CHECK((attenuated_mean(T(0)) == 1 && attenuated_mean(infinite) == 0 && attenuated_mean(T(-3)) == 1));
    CHECK((attenuated_mean(nan) == 1 && transmittance_over(nan) == 1 && transmittance_over(T(0)) == 1));
    CHECK(transmittance_over(infinite) <= T(1e-37));
    CHECK((attenuated_length(infinite, T(0.5)) == 2 && attenuated_length(infinite, T(0)) == infinite));
    CHECK((attenuated_length(T(0), infinite) == 0 && attenuated_length(infinite, infinite) == 0));
    CHECK(
        (attenuated_length(T(3), T(0)) == 3 && attenuated_length(T(3), nan) == 3 && attenuated_length(nan, T(1)) == 0));
    hostile_source<T> source(1);
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        const auto x = source.draw();
        const T length = attenuated_length(x[0], x[1]);
        REQUIRE((length >= 0 && (std::isnan(x[0]) || length <= std::max(T(0), x[0]))));
        REQUIRE(!std::isnan(height_fog_amount(x[0], x[1], x[2])));
        REQUIRE(height_fog_weight(x[0], x[1], x[2], x[3]) >= 0);
        const T phase = phase_henyey_greenstein(x[0], x[1]);
        REQUIRE((std::isnan(x[0]) || (phase > 0 && std::isfinite(phase))));
    }
}

TEST_CASE("phase functions integrate to 1 over the sphere, and have the mean cosine that they are given")
{
    CHECK(4 * pi * phase_isotropic == doctest::Approx(1).epsilon(1e-15));
    for (const double g : {-0.9, -0.5, -0.1, 0.0, 0.3, 0.76, 0.95}) {
        const auto over_sphere = [&](auto f) {
            return 2 * pi * integral(-1, 1, 200'000, [&](double c) { return f(c) * phase_henyey_greenstein(c, g); });
        };
        CHECK(over_sphere([](double) { return 1.0; }) == doctest::Approx(1).epsilon(1e-8));
        CHECK(over_sphere([](double c) { return c; }) == doctest::Approx(g).epsilon(1e-8));
    }
    for (const float c : {-1.0f, 0.2f, 1.0f}) CHECK(phase_henyey_greenstein(c, 0.0f) == float(phase_isotropic));
    CHECK(phase_henyey_greenstein(1.0f, 1.0f) == phase_henyey_greenstein(1.0f, float(phase_greatest_asymmetry)));
    CHECK(phase_henyey_greenstein(-1.0f, -0.7f) == phase_henyey_greenstein(1.0f, 0.7f));
}

TEST_CASE_TEMPLATE("Henyey-Greenstein phases have their stated error", T, float, double)
{
    check_error(10, 2, evaluations, [](const place& p) {
        const T cosine = T(2 * p[0] - 1), g = T(p[1] - 0.5);
        const wide d = 1 + wide(g) * wide(g) - 2 * wide(g) * wide(cosine);
        return relative(phase_henyey_greenstein(cosine, g),
                        (1 - wide(g) * wide(g)) / (4 * 3.14159265358979323846L * d * std::sqrt(d)));
    });
}

TEST_CASE("the directions to light and camera have the signs of the polar angle")
{
    bit_source bits(2);
    for (std::int64_t i = 0; i < effort(10'000); ++i) {
        const double x = bits.uniform(-1, 1), y = bits.uniform(-1, 1), z = bits.uniform(-1, 1);
        const double to_light[] = {0, 0, -1}, s = std::sqrt(x * x + y * y + z * z);
        const double to_camera[] = {-x / s, -y / s, -z / s};
        const double product = to_light[2] * to_camera[2];
        const double polar = rectified_from_position(x, y, z).polar;
        REQUIRE(std::cos(polar) == doctest::Approx(product).epsilon(1e-12));
        REQUIRE(adaptive_overestimation(std::cos(polar)) == doctest::Approx((1 + product) / 2).epsilon(1e-12));
    }
    // Into the light, where it goes straight on to the camera: the greatest phase, and depth -1.
    const double into = rectified_cosine(0.0, 0.0, -2.0);
    CHECK(into == -1);
    CHECK(rectified_from_position(0.0, 0.0, -2.0).polar == doctest::Approx(pi));
    CHECK(rectified_polar_depth(pi, rectified_polar_range(0.0, pi)) < -0.9);
    CHECK(phase_henyey_greenstein(-into, 0.5) > phase_henyey_greenstein(into, 0.5));
}

TEST_CASE_TEMPLATE("no light leaks at the epipole and none is lost at the antipode, for any bounds", T, float, double)
{
    bit_source bits(3);
    for (std::int64_t i = 0; i < effort(10'000); ++i) {
        const T lower = T(bits.uniform(0, 1)), weight = T(bits.uniform(0, 1 - double(lower)));
        const hamburger_bounds<T> bounds{lower, T(lower + weight), weight};
        REQUIRE(bounds_intensity(bounds, adaptive_overestimation(T(-1))) == std::min(T(1), bounds.upper));
        REQUIRE(bounds_intensity(bounds, adaptive_overestimation(T(1))) == lower);
        REQUIRE(bounds_intensity(bounds, plateau_overestimation(T(-1))) == std::min(T(1), bounds.upper));
        REQUIRE(bounds_intensity(bounds, plateau_overestimation(T(1))) == lower);
    }
    T before = 0;
    for (int i = -1000; i <= 1000; ++i) {
        const T cosine = T(i) / 1000, plateau = plateau_overestimation(cosine);
        CHECK((plateau >= before && std::abs(adaptive_overestimation(cosine) - (1 + cosine) / 2) <= T(u<T>)));
        CHECK(std::abs(plateau - T((1 + std::pow(double(cosine), i < 0 ? 5 : 1)) / 2)) <= T(4 * u<T>));
        before = plateau;
    }
    const T five_degrees = T(std::cos(5 * pi / 180));
    CHECK(plateau_overestimation(-five_degrees) <= T(0.01));
    for (const T nan : {std::numeric_limits<T>::quiet_NaN(), -std::numeric_limits<T>::quiet_NaN()})
        CHECK((adaptive_overestimation(nan) == 1 && plateau_overestimation(nan) == 1));
}

TEST_CASE_TEMPLATE("radiance is that of numerical integration along a ray with a lit part, and has its stated error", T,
                   float, double)
{
    bit_source bits(4);
    for (int i = 0; i < 200; ++i) {
        const double s = bits.uniform(0, 5), sigma = bits.uniform(0, 2), scattering = sigma * bits.uniform(0, 1);
        const double from = bits.uniform(0, s), to = bits.uniform(from, s), surface = bits.uniform(0, 3), phase = 0.1;
        const double lit = integral(from, to, 200, [&](double t) { return std::exp(-sigma * t); });
        const double all = integral(0, s, 200, [&](double t) { return std::exp(-sigma * t); });
        const double want = std::exp(-sigma * s) * surface + scattering * phase * 7 * lit;
        const T intensity = T(all > 0 ? 1 - lit / all : 0);
        const T got = scattering_radiance(T(surface), intensity, T(s), T(sigma), T(scattering), T(phase), T(7));
        CHECK(double(got) == doctest::Approx(want).epsilon(is_float<T> ? 1e-5 : 1e-9));
    }
    check_error(9, 4, evaluations, [](const place& p) {
        const T s = magnitude<T>(p[0], 4), sigma = T(p[1]) / s, surface = T(p[2]), intensity = T(p[3] / 2);
        const wide want = std::exp(-wide(sigma) * wide(s)) * wide(surface) +
                          wide(T(0.3)) * wide(T(0.1)) * 7 * length_of(s, sigma) * (1 - wide(intensity));
        return relative(scattering_radiance(surface, intensity, s, sigma, T(0.3), T(0.1), T(7)), want);
    });
    CHECK(scattering_radiance(T(0), T(1), T(5), T(0.2), T(0.1), T(0.1), T(7)) == 0);
    CHECK(scattering_radiance(T(2), T(0.3), T(0), T(0.2), T(0.1), T(0.1), T(7)) == 2);
}

TEST_CASE("fog is that of numerical integration, for rays that rise and that descend, and has its stated errors")
{
    bit_source bits(5);
    for (int i = 0; i < 300; ++i) {
        const double a = bits.uniform(0, 3), b = a + bits.uniform(0, 2), decay = bits.uniform(-2, 2),
                     sigma = bits.uniform(0, 2);
        const auto density = [&](double t) { return std::exp(-decay * t); };
        const auto amount = [&](double t) { return -std::expm1(-decay * t) / decay; };
        const double weight = integral(a, b, 400, [&](double t) { return density(t) * std::exp(-sigma * amount(t)); });
        CHECK(height_fog_amount(a, b, decay) == doctest::Approx(integral(a, b, 400, density)).epsilon(1e-9));
        CHECK(height_fog_weight(a, b, decay, sigma) == doctest::Approx(weight).epsilon(1e-8));
    }
    CHECK(height_fog_amount(1.0, 4.0, 0.0) == 3);
    CHECK(height_fog_weight(1.0, 4.0, 0.0, 0.0) == 3);
    CHECK(height_fog_weight(0.0, 2.0, 0.0, 0.7) == attenuated_length(2.0, 0.7));
}

TEST_CASE_TEMPLATE("amounts and weights of fog have their stated errors", T, float, double)
{
    const auto amount = [](T a, T b, T decay) { // between two distances
        return std::exp(-wide(decay) * wide(a)) *
               (decay == 0 ? wide(b) - wide(a) : -std::expm1(-wide(decay) * (wide(b) - wide(a))) / wide(decay));
    };
    const auto ends = [](const place& p) {
        const T a = T(4 * p[0]);
        return std::array{a, T(a + magnitude<T>(p[1], 4))};
    };
    check_error(1, 3, evaluations, [&](const place& p) {
        const auto [a, b] = ends(p);
        const T decay = T(4 * p[2] - 2);
        return relative(height_fog_amount(a, b, decay), amount(a, b, decay)) / (8 + 2 * std::abs(double(decay * b)));
    });
    check_error(1, 4, evaluations, [&](const place& p) {
        const auto [a, b] = ends(p);
        const T decay = T(2 * p[2] - 1), sigma = T(p[3]);
        const wide before = amount(0, a, decay), within = amount(a, b, decay);
        const wide want = std::exp(-wide(sigma) * before) * length_of(within, sigma);
        const double depth = double(wide(sigma) * (before + within));
        return relative(height_fog_weight(a, b, decay, sigma), want) /
               ((1 + depth) * (16 + 4 * std::abs(double(decay * b))));
    });
}
