// Mean blocker depths: those of the canonical distribution, node by node, in double and in 120 digits; exact for as many
// surfaces as the moments determine; in [-1, z_f] for any input; with the errors that headers state for float.
#include "support/climber.hpp"
#include "support/contacts.hpp"
#include "support/moments_of.hpp"
#include "support/oracle.hpp"
#include "support/statistics.hpp"

#include <gnomon/comparators/hamburger_cholesky.h>
#include <gnomon/storage/moments4_summed.h>
#include <gnomon/storage/moments6_summed.h>
#include <gnomon/storage/variance_summed.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

using namespace gnomon;
using namespace gnomon::test;

namespace {

/// The mean blocker depth of depths with weights, by Equation 4.
template <class Number, std::size_t n>
double equation4(const std::array<Number, n>& depths, const std::array<Number, n>& weights, double z_f)
{
    Number distance = 0, weight = 0;
    for (std::size_t i = 0; i < n; ++i)
        if (depths[i] < z_f) distance += weights[i] * (z_f - depths[i]), weight += weights[i];
    return std::max(-1.0, double(z_f - distance / (blocker_epsilon + weight)));
}

double by_nodes(const hankel4<double>& h, double z_f)
{
    const auto d = hamburger4_distribution(h, z_f);
    return equation4(std::array{d.depth1, d.depth2}, std::array{d.weight1, d.weight2}, z_f);
}
double by_nodes(const hankel6<double>& h, double z_f)
{
    const auto d = hamburger6_distribution(h, z_f);
    return equation4(std::array{d.depth1, d.depth2, d.depth3}, std::array{d.weight1, d.weight2, d.weight3}, z_f);
}
double by_formula(const hankel4<double>& h, double z_f) { return blocker4_depth(h, z_f); }
double by_formula(const hankel6<double>& h, double z_f) { return blocker6_depth(h, z_f); }

auto factored(const std::array<double, 4>& b, double alpha)
{
    return hankel4_constant_bias(moments4_in<double>(b), bias4_theta_b2, bias4_theta_b4, alpha);
}
auto factored(const std::array<double, 6>& b, double alpha)
{
    return hankel6_constant_bias(moments6_in<double>(b), bias6_theta_b2, bias6_theta_b4, bias6_theta_b6, alpha);
}

/// Calls each(distribution, z_f) for distributions of all families.
template <class Each> void for_each_sight(std::int64_t count, std::uint64_t seed, Each each)
{
    distribution_source source(seed);
    for (int f = 0; f < family_count; ++f)
        for (std::int64_t i = 0; i < effort(count); ++i) {
            const distribution d = source.draw(family(f));
            each(d, double(float(source.receiver(d))));
        }
}

/// Checks a row of a header: quantiles over the families, and the largest error that a search finds, of what error(d, z_f)
/// returns.
template <class Error> void check_row(const std::string& header, const std::string& name, Error error)
{
    error_sample sample;
    for_each_sight(2000, 3, [&](const distribution& d, double z_f) { sample.add(error(d, z_f)); });
    const summit top = climb(sight_dimensions, 200'000, 3, [&](const std::vector<double>& place) {
        const sight s = sight_at(place);
        return error(s.seen, s.receiver);
    });
    const error_row row = stated_error(header, name);
    std::printf("%s: p99 %.3g, p99.9 %.3g, max %.3g\n", name.c_str(), sample.quantile(0.99), sample.quantile(0.999),
                top.score);
    CHECK(sample.quantile(0.99) <= row.p99);
    CHECK(sample.quantile(0.999) <= row.p999);
    CHECK(top.score <= row.maximum);
}

template <std::size_t m> void check_oracle(const std::string& header, std::size_t depths)
{
    error_sample sample;
    for_each_sight(300, 5, [&](const distribution& d, double z_f) {
        if (d.depths.size() < depths) return;
        const auto b = moments_of<m>(d);
        high_moments<m> exact{1};
        std::copy(b.begin(), b.end(), exact.begin() + 1);
        const auto r = oracle<m>(exact, z_f);
        if (!r.valid) return;
        sample.add(by_formula(factored(b, 0), z_f) - equation4(r.depths, r.weights, z_f));
    });
    const error_row row = stated_error(header, "double, no bias");
    std::printf("%zu moments, double: p99 %.3g, p99.9 %.3g of %zu\n", m, sample.quantile(0.99), sample.quantile(0.999),
                sample.size());
    CHECK(sample.quantile(0.99) <= row.p99);
    CHECK(sample.quantile(0.999) <= row.p999);
}

/// A distribution of these depths with random weights, and its moments in double.
distribution surfaces(std::initializer_list<double> depths, bit_source& bits)
{
    distribution d;
    double sum = 0;
    for (const double z : depths) d.depths.push_back(z), d.weights.push_back(bits.uniform(0.1, 1));
    for (const double w : d.weights) sum += w;
    for (double& w : d.weights) w /= sum;
    return d;
}

template <std::size_t m> double error_of(const distribution& d, double z_f)
{
    double distance = 0;
    for (std::size_t i = 0; i < d.depths.size(); ++i) distance += d.weights[i] * std::max(0.0, z_f - d.depths[i]);
    const double want = z_f - distance / (blocker_epsilon + d.below(z_f));
    return std::abs(by_formula(factored(moments_of<m>(d), 0), z_f) - want);
}

} // namespace

TEST_CASE("the closed form is the mean over the nodes")
{
    error_sample four, six;
    for_each_sight(2000, 1, [&](const distribution& d, double z_f) {
        const auto h4 = factored(moments_of<4>(d), 7e-7);
        const auto h6 = factored(moments_of<6>(d), 6e-6);
        four.add(by_formula(h4, z_f) - by_nodes(h4, z_f));
        six.add(by_formula(h6, z_f) - by_nodes(h6, z_f));
    });
    CHECK(four.quantile(0.999) <= 1e-12);
    CHECK(six.quantile(0.999) <= 1e-11);
    CHECK(four.quantile(1) <= 1e-8);
    CHECK(six.quantile(1) <= 1e-8);
}

TEST_CASE("against the moment problem in 120 digits")
{
    check_oracle<4>("soft/blocker.h", 3);
    check_oracle<6>("soft/blocker6.h", 4);
}

TEST_CASE("exact for one and two surfaces, and for three with one at the receiver")
{
    bit_source bits(7);
    for (std::int64_t i = 0; i < effort(20'000); ++i) {
        const double a = bits.uniform(-1, 0.2), b = bits.uniform(a + 0.05, 0.6), c = bits.uniform(b + 0.05, 1);
        for (const double z_f : {a, b, c, 1.0}) {
            // One or two surfaces leave pivots at their floor, 2^-66, which counts for the square root of that.
            REQUIRE(error_of<4>(surfaces({a}, bits), z_f) < 1e-6);
            REQUIRE(error_of<4>(surfaces({a, b}, bits), z_f) < 1e-6);
            REQUIRE(error_of<6>(surfaces({a, b, c}, bits), z_f) < 1e-4);
        }
        for (const double z_f : {a, b, c}) REQUIRE(error_of<4>(surfaces({a, b, c}, bits), z_f) < 1e-6);
        const distribution two = surfaces({a, c}, bits);
        const auto m = moments_of<2>(two);
        const double want = c - two.weights[0] * (c - a) / (blocker_epsilon + two.weights[0]);
        REQUIRE(std::abs(blocker2_depth(m[0], m[1] - m[0] * m[0], c) - want) < 1e-9);
    }
}

TEST_CASE_TEMPLATE("any input gives a depth in [-1, z_f], and no information gives z_f", T, float, double)
{
    hostile_source<T> source(1);
    const auto check = [](T z_b, T z_f) {
        REQUIRE(-1 <= z_b);
        REQUIRE(z_b <= (std::isnan(z_f) ? T(1) : std::clamp(z_f, T(-1), T(1))));
    };
    for (std::int64_t i = 0; i < effort(200'000); ++i) {
        const auto x = source.draw();
        const T z_f = x[6];
        const moments4<T> b4{x[0], x[1], x[2], x[3]};
        const moments6<T> b6{x[0], x[1], x[2], x[3], x[4], x[5]};
        check(blocker2_depth(x[0], x[1], z_f), z_f);
        check(blocker4_depth(hankel4_from_moments(b4), z_f), z_f);
        check(blocker4_depth(hankel4<T>{x[0], x[1], x[2], x[3]}, z_f), z_f);
        check(blocker6_depth(hankel6_from_moments(b6), z_f), z_f);
        check(hamburger4_cholesky_blocker(b4, z_f), z_f);
    }
    const T nan = std::numeric_limits<T>::quiet_NaN();
    for (std::size_t k = 0; k < 4; ++k) {
        std::array<T, 4> b{T(0.1), T(0.3), T(0), T(0.2)};
        b[k] = nan;
        CHECK(blocker4_depth(hankel4_from_moments(gnomon_bit_cast<moments4<T>>(b)), T(0.5)) == T(0.5));
    }
    CHECK(blocker4_depth(hankel4_from_moments(moments4<T>{0, T(0.5), 0, T(0.5)}), nan) ==
          blocker4_depth(hankel4_from_moments(moments4<T>{0, T(0.5), 0, T(0.5)}), T(1)));
}

TEST_CASE("blocker depths in float have their stated errors")
{
    check_row("soft/blocker.h", "float, hankel4_from_summed", [](const distribution& d, double z_f) {
        const channels4<double> c = in_double(gnomon_bit_cast<channels4<float>>(theta4(moments4_of(d))));
        const channels4<float> f{float(c.c1), float(c.c2), float(c.c3), float(c.c4)};
        return std::abs(double(moments4_summed_blocker(f, 784, float(z_f))) - moments4_summed_blocker(c, 784, z_f));
    });
    check_row("soft/blocker6.h", "float, hankel6_from_summed", [](const distribution& d, double z_f) {
        const channels6<float> f = theta6(moments6_of(d));
        return std::abs(double(moments6_summed_blocker(f, 784, float(z_f))) -
                        moments6_summed_blocker(in_double(f), 784, z_f));
    });
    check_row("storage/variance_summed.h", "float, variance_summed_blocker", [](const distribution& d, double z_f) {
        const auto b = moments_of<2>(d);
        const channels2<float> f{float(0.5 + 0.5 * b[0]), float(b[1])};
        return std::abs(double(variance_summed_blocker(f, 784, float(z_f))) -
                        variance_summed_blocker(channels2<double>{double(f.c1), double(f.c2)}, 784, z_f));
    });
}

TEST_CASE("Algorithm 1 as printed, with the paper's bias of 6e-7, is off by over ten times as much")
{
    error_sample ours, printed;
    for_each_sight(2000, 3, [&](const distribution& d, double z_f) {
        const channels4<float> c = theta4(moments4_of(d));
        const auto paper = [](auto b) {
            using T = decltype(b.b1);
            return moments4_add_bias(b, T(bias4_theta_paper_b2), T(bias4_theta_paper_b4), T(6e-7f));
        };
        ours.add(double(moments4_summed_blocker(c, 784, float(z_f))) - moments4_summed_blocker(in_double(c), 784, z_f));
        printed.add(double(hamburger4_cholesky_blocker(paper(theta4_inverse(c)), float(z_f))) -
                    hamburger4_cholesky_blocker(paper(theta4_inverse(in_double(c))), z_f));
    });
    std::printf("p99.9: %.3g, Algorithm 1 %.3g\n", ours.quantile(0.999), printed.quantile(0.999));
    CHECK(printed.quantile(0.999) > 10 * ours.quantile(0.999));
}
