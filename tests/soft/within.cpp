// The sharp bound for depths in [-1, 1] (hausdorff4.h): attained by a distribution in [-1, 1], never above the truth from a
// summed-area table, and less leaking than the bound for any depths.
#include "support/climber.hpp"
#include "support/contacts.hpp"
#include "support/distributions.hpp"
#include "support/moments_of.hpp"
#include "support/statistics.hpp"

#include <gnomon/storage/moments4_summed_within.h>

#include <Eigen/Dense>
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

using namespace gnomon;
using namespace gnomon::test;

namespace {

moments4<double> exact(const distribution& d)
{
    const auto b = moments_of<4>(d);
    return {b[0], b[1], b[2], b[3]};
}

/// The mean channels of a distribution from a table for sums of most_texels codes.
channels4<float> summed(const distribution& d, double most_texels)
{
    const double scale = double(summed_area_scale(float(most_texels)));
    const channels4<double> c = theta4(exact(d));
    const auto code = [scale](double x) { return float(std::floor(x * scale + 0.5) / scale); };
    return {code(c.c1), code(c.c2), code(c.c3), code(c.c4)};
}

using polynomial = std::array<double, 5>;

/// The factor by which errors of channels of theta4 may change E[p].
double channel_norm(const polynomial& p)
{
    return std::abs(p[1] / 3 + 0.75 * p[3]) + std::sqrt(3.0) * std::abs(p[1] + 0.75 * p[3]) +
           std::abs(p[2] - p[4]) / 8 + std::abs(p[2] + p[4]);
}

/// The largest error of the channels of b* = (0, b2, 0, b4) that leaves moments of depths in [-1, 1]: the least quotient
/// of E[p] and its norm over p = q^2 and p = (1 - z^2) l^2.
double distance_from_boundary(double b2, double b4)
{
    double least = 1;
    const auto add = [&](const polynomial& p) {
        const double norm = channel_norm(p);
        if (norm > 1e-9) least = std::min(least, (p[0] + b2 * p[2] + b4 * p[4]) / norm);
    };
    constexpr int steps = 720;
    constexpr double step = 3.14159265358979 / steps;
    for (int i = 0; i < steps; ++i) {
        const double l0 = -std::sin(i * step), l1 = std::cos(i * step);
        add({l0 * l0, 2 * l0 * l1, l1 * l1 - l0 * l0, -2 * l0 * l1, -l1 * l1});
        for (int j = i; j < steps; ++j) {
            const double q0 = std::sin(i * step) * std::sin(j * step), q2 = std::cos(i * step) * std::cos(j * step);
            const double q1 = -std::sin((i + j) * step);
            add({q0 * q0, 2 * q0 * q1, q1 * q1 + 2 * q0 * q2, 2 * q1 * q2, q2 * q2});
        }
    }
    return least;
}

/// How far the distribution at -1, z_f, 1 and one depth more is from the moments b, from weights of at least 0, and from
/// the share lower before z_f.
double attained_error(const moments4<double>& b, double z_f, double lower)
{
    const double e0 = b.b2 - 1, e1 = b.b3 - b.b1, e2 = b.b4 - b.b2;
    const double x = (e2 - z_f * e1) / (e1 - z_f * e0);
    const std::array nodes{-1.0, z_f, x, 1.0};
    Eigen::Matrix4d powers;
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 4; ++k) powers(k, i) = std::pow(nodes[std::size_t(i)], k);
    const Eigen::Vector4d weights = powers.fullPivLu().solve(Eigen::Vector4d(1, b.b1, b.b2, b.b3));
    double error = std::max(0.0, -weights.minCoeff());
    error = std::max(
        error, std::abs(weights[0] + weights[1] * std::pow(z_f, 4) + weights[2] * std::pow(x, 4) + weights[3] - b.b4));
    return std::max(error, std::abs(weights[0] + (x < z_f ? weights[2] : 0) - lower));
}

} // namespace

TEST_CASE("the bound is attained by a distribution in [-1, 1], and is that for any depths or above")
{
    distribution_source source(3);
    int sharper = 0;
    for (int i = 0; i < 4000; ++i) {
        const distribution d = source.draw(family::five_points);
        const double z_f = source.uniform(-0.99, 0.99);
        const moments4<double> b = exact(d);
        const hankel4<double> h = hankel4_from_moments(b);
        const double lower = hausdorff4_lower(h, z_f), any = hamburger4_lower(h, z_f);
        CHECK(lower >= any);
        CHECK(lower <= d.below(z_f) + 1e-9);
        if (lower == any) continue;
        ++sharper;
        CHECK(attained_error(b, z_f, lower) < 1e-7);
    }
    CHECK(sharper > 800);
}

TEST_CASE("the bias vector is as far from the boundary as stated, and no neighbour is farther")
{
    const double b2 = bias4_theta_within_b2, b4 = bias4_theta_within_b4, r = distance_from_boundary(b2, b4);
    CHECK(r == doctest::Approx(0.1616).epsilon(1e-3));
    CHECK(moments4_summed_within_bias_ratio * r >= 1);
    for (const double step : {-0.01, 0.01}) {
        CHECK(distance_from_boundary(b2 + step, b4) < r);
        CHECK(distance_from_boundary(b2, b4 + step) < r);
    }
    CHECK(distance_from_boundary(bias4_theta_b2, bias4_theta_b4) < 1e-9);
}

TEST_CASE("shadows from a table never darken a lit surface, and have their stated errors")
{
    const std::string header = "moments/hausdorff4.h";
    const error_row row = stated_error(header, "float, hankel4_from_summed_within");
    for (const double most : {4.0, 784.0, 4096.0, 65536.0}) {
        const double weight = moments4_summed_within_weight(most);
        const summit darkest = climb(sight_dimensions, 400'000, 1, [&](const std::vector<double>& place) {
            const sight s = sight_at(place);
            const float z_f = float(s.receiver);
            return double(moments4_summed_intensity_within(summed(s.seen, most), float(most), z_f)) -
                   s.seen.below(double(z_f));
        });
        const summit error = climb(sight_dimensions, 100'000, 2, [&](const std::vector<double>& place) {
            const sight s = sight_at(place);
            const float z_f = float(s.receiver);
            const channels4<float> c = summed(s.seen, most);
            return std::abs(double(moments4_summed_intensity_within(c, float(most), z_f)) -
                            moments4_summed_intensity_within(in_double(c), most, double(z_f)));
        });
        std::printf("%g texels: darkness %.3g of %.3g, error %.3g\n", most, darkest.score, weight, error.score);
        CHECK(darkest.score <= weight);
        CHECK(error.score <= row.maximum);
    }
    error_sample sample;
    distribution_source source(7);
    for (int f = 0; f < family_count; ++f)
        for (int i = 0; i < 2000; ++i) {
            const distribution d = source.draw(family(f));
            const float z_f = float(source.receiver(d));
            const channels4<float> c = summed(d, 784);
            sample.add(double(moments4_summed_intensity_within(c, 784, z_f)) -
                       moments4_summed_intensity_within(in_double(c), 784, double(z_f)));
        }
    std::printf("error p99 %.3g, p99.9 %.3g\n", sample.quantile(0.99), sample.quantile(0.999));
    CHECK(sample.quantile(0.99) <= row.p99);
    CHECK(sample.quantile(0.999) <= row.p999);
}

TEST_CASE("light leaks less than by the bound for any depths: 6% for receivers of the families, 0.2% on a depth")
{
    distribution_source source(5);
    std::array<double, 2> any{}, within{};
    for (int f = 0; f < family_count; ++f)
        for (int i = 0; i < 1000; ++i) {
            const distribution d = source.draw(family(f));
            const double on = d.depths[std::size_t(source.uniform(0, double(d.depths.size()) * 0.9999999))];
            const std::array receivers{double(float(source.receiver(d))), double(float(on))};
            const channels4<float> c = summed(d, 784);
            for (std::size_t k = 0; k < 2; ++k) {
                const float z_f = float(receivers[k]);
                const double truth = d.below(receivers[k]);
                any[k] += truth - double(moments4_summed_intensity(c, 784, z_f));
                within[k] += truth - double(moments4_summed_intensity_within(c, 784, z_f));
            }
        }
    std::printf("leak: %.1f%% less, on a depth %.1f%% less\n", 100 * (1 - within[0] / any[0]),
                100 * (1 - within[1] / any[1]));
    CHECK(within[0] < 0.94 * any[0]);
    CHECK(within[1] < 0.998 * any[1]);
}
