// Translucent fragments, against sums in double: moments of a stack are those of its distribution, blended back to front or
// folded front to back; the shadow of a stack is a product of transmittances and lies within the bounds.
#include "support/effort.hpp"
#include "support/moments_of.hpp"
#include "support/rounding.hpp"
#include "support/stacks.hpp"

#include <gnomon/moments/bias.h>
#include <gnomon/moments/hamburger4.h>
#include <gnomon/moments/hamburger6.h>
#include <gnomon/moments/quantization.h>
#include <gnomon/moments/translucency.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

using namespace gnomon;
using namespace gnomon::test;

namespace {

template <class T> constexpr T nan_of = std::numeric_limits<T>::quiet_NaN();

/// Four or six moments, as functions and as numbers.
template <class T, std::size_t m> struct kind;
template <class T> struct kind<T, 4> {
    using moments = moments4<T>;
    static moments of_depth(T z) { return moments4_from_depth(z); }
    static moments over(moments b, T z, T alpha) { return moments4_over(b, z, alpha); }
    static moments add(moments sum, moments b, T weight) { return moments4_add(sum, b, weight); }
};
template <class T> struct kind<T, 6> {
    using moments = moments6<T>;
    static moments of_depth(T z) { return moments6_from_depth(z); }
    static moments over(moments b, T z, T alpha) { return moments6_over(b, z, alpha); }
    static moments add(moments sum, moments b, T weight) { return moments6_add(sum, b, weight); }
};

template <class T, std::size_t m> typename kind<T, m>::moments back_to_front(const stack& s)
{
    auto b = kind<T, m>::of_depth(T(s.behind));
    for (std::size_t k = 0; k < s.size(); ++k) b = kind<T, m>::over(b, T(s.depths[k]), T(s.alphas[k]));
    return b;
}

template <class T, std::size_t m> typename kind<T, m>::moments from_the_front(const stack& s)
{
    if (s.size() == 0) return kind<T, m>::of_depth(T(s.behind));
    typename kind<T, m>::moments sum{};
    front_to_back<T> state{};
    for (std::size_t k = s.size(); k-- > 0;) {
        state = k + 1 == s.size() ? front_to_back_begin(T(s.alphas[k])) : front_to_back_add(state, T(s.alphas[k]));
        sum = kind<T, m>::add(sum, kind<T, m>::of_depth(T(s.depths[k])), state.weight);
    }
    return kind<T, m>::add(sum, kind<T, m>::of_depth(T(s.behind)), state.transmittance);
}

template <class T, std::size_t m> double largest_difference(const auto& b, const std::array<double, m>& exact)
{
    const auto numbers = std::bit_cast<std::array<T, m>>(b);
    double largest = 0;
    for (std::size_t j = 0; j < m; ++j) largest = std::max(largest, std::abs(double(numbers[j]) - exact[j]));
    return largest;
}

template <class T, std::size_t m> void check_moments(const stack& s)
{
    const auto exact = moments_of<m>(s.weighted());
    // 2 roundings of each blend, and those of the powers and of depth and opacity themselves.
    const double allowed = (2 * double(s.size()) + 10) * u<T>;
    REQUIRE(largest_difference<T, m>(back_to_front<T, m>(s), exact) <= allowed);
    REQUIRE(largest_difference<T, m>(from_the_front<T, m>(s), exact) <= allowed);
}

/// Checks that two stacks have the same moments but for rounding.
void check_alike(const stack& a, const stack& b)
{
    REQUIRE(largest_difference<double, 4>(back_to_front<double, 4>(a), moments_of<4>(b.weighted())) <= 1e-14);
    REQUIRE(largest_difference<double, 6>(back_to_front<double, 6>(a), moments_of<6>(b.weighted())) <= 1e-14);
}

template <class Each> void for_each_stack(std::int64_t count, Each each)
{
    bit_source bits(1);
    for (std::int64_t i = 0; i < effort(count); ++i) each(any_stack(bits), bits);
}

} // namespace

TEST_CASE("moments of a stack are those of its distribution, in either order of the fold")
{
    for_each_stack(20'000, [](const stack& s, bit_source&) {
        check_moments<double, 4>(s);
        check_moments<double, 6>(s);
        check_moments<float, 4>(s);
        check_moments<float, 6>(s);
    });
}

TEST_CASE("the shadow of a stack is 1 less its transmittance, and within the bounds")
{
    for_each_stack(20'000, [](const stack& s, bit_source& bits) {
        const distribution d = s.weighted();
        const double z_f = bits.chance(0.3) ? d.depths[bits.below(d.depths.size())] : bits.uniform(-1, 1);
        const double shadow = 1 - s.transmittance(z_f);
        REQUIRE(std::abs(d.below(z_f) - shadow) <= 1e-14);
        // A bias of weight alpha moves bounds by alpha, and keeps arithmetic in double exact enough.
        const double alpha = 1e-9;
        const auto four = hamburger4_bounds(
            hankel4_constant_bias(back_to_front<double, 4>(s), bias4_raw_b2, bias4_raw_b4, alpha), z_f);
        const auto six = hamburger6_bounds(
            hankel6_constant_bias(back_to_front<double, 6>(s), bias6_raw_b2, bias6_raw_b4, bias6_raw_b6, alpha), z_f);
        for (const auto& bounds : std::array{four, six}) {
            REQUIRE(bounds.lower <= shadow + 2 * alpha);
            REQUIRE(shadow <= bounds.upper + 2 * alpha);
        }
    });
}

TEST_CASE("fragments of one depth commute")
{
    for_each_stack(20'000, [](const stack& s, bit_source& bits) {
        if (s.size() < 2) return;
        stack swapped = s;
        const std::size_t k = bits.below(s.size() - 1);
        swapped.depths[k] = swapped.depths[k + 1];
        stack other = swapped;
        std::swap(other.alphas[k], other.alphas[k + 1]);
        check_alike(swapped, other);
    });
}

TEST_CASE_TEMPLATE("opacities outside [0, 1] are clamped, and a NaN is no fragment and no information", T, float,
                   double)
{
    const moments4<T> below = moments4_from_depth(T(0.25));
    const auto same = [](const moments4<T>& a, const moments4<T>& b) {
        return a.b1 == b.b1 && a.b2 == b.b2 && a.b3 == b.b3 && a.b4 == b.b4;
    };
    const T infinity = std::numeric_limits<T>::infinity(), z = T(-0.5);
    for (const T none : {T(0), T(-0.0), T(-1), -infinity, nan_of<T>}) {
        CHECK(same(moments4_over(below, z, none), below));
        CHECK(over(T(3), nan_of<T>, none) == 3);
        CHECK(front_to_back_begin(none).transmittance == 1);
        CHECK(front_to_back_add(front_to_back_begin(T(0.5)), none).weight == 0);
    }
    for (const T all : {T(1), T(2), infinity}) {
        CHECK(same(moments4_over(below, z, all), moments4_from_depth(z)));
        CHECK(over(nan_of<T>, T(3), all) == 3);
        CHECK(front_to_back_begin(all).transmittance == 0);
        CHECK(front_to_back_add(front_to_back_begin(T(0.5)), all).weight == T(0.5));
    }
    const moments4<T> unknown = moments4_over(below, nan_of<T>, T(0.5));
    CHECK(same(unknown, moments4_over(below, T(1), T(0.5))));
    CHECK(same(moments4_over(below, T(-7), T(0.5)), moments4_over(below, T(-1), T(0.5))));
    CHECK(moments6_over(moments6_from_depth(T(0.25)), nan_of<T>, T(1)).b6 == 1);
    CHECK(std::isnan(over(nan_of<T>, T(3), T(0.5))));
}

TEST_CASE("without fragments the surface behind is left, and an opaque fragment hides all behind")
{
    CHECK(largest_difference<double, 4>(back_to_front<double, 4>({0.5, {}, {}}), {0.5, 0.25, 0.125, 0.0625}) == 0);
    const stack opaque{0.75, {0.5, 0.25, -0.5}, {0.3, 1, 1}};
    CHECK(largest_difference<double, 4>(back_to_front<double, 4>(opaque), {-0.5, 0.25, -0.125, 0.0625}) == 0);
    CHECK(largest_difference<double, 4>(from_the_front<double, 4>(opaque), {-0.5, 0.25, -0.125, 0.0625}) == 0);
    check_alike(opaque, {-0.5, {}, {}});
}

// Of stochastic transparency every outcome is enumerated: which fragments survive, each with probability alpha.
TEST_CASE("the nearest fragment that survives by chance has the distribution of the stack, in any order")
{
    for_each_stack(2'000, [](const stack& s, bit_source& bits) {
        std::vector<std::size_t> order(s.size());
        for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
        for (std::size_t k = order.size(); k > 1; --k) std::swap(order[k - 1], order[bits.below(k)]);
        std::array<double, 4> mean{};
        for (std::size_t outcome = 0; outcome >> s.size() == 0; ++outcome) {
            double probability = 1, nearest = s.behind;
            for (const std::size_t k : order) {
                const bool survives = outcome >> k & 1;
                probability *= survives ? s.alphas[k] : 1 - s.alphas[k];
                if (survives) nearest = std::min(nearest, s.depths[k]);
            }
            const auto b = moments4_from_depth(nearest);
            mean = {mean[0] + probability * b.b1, mean[1] + probability * b.b2, mean[2] + probability * b.b3,
                    mean[3] + probability * b.b4};
        }
        REQUIRE(largest_difference<double, 4>(back_to_front<double, 4>(s), mean) <= 1e-12);
    });
}

TEST_CASE_TEMPLATE("one blend is within its stated error", T, float, double)
{
    bit_source bits(2);
    double largest = 0;
    for (std::int64_t i = 0; i < effort(1'000'000); ++i) {
        const T below = T(bits.uniform(-1, 1)), above = T(bits.uniform(-1, 1));
        const T alpha = bits.chance(0.5) ? T(bits.uniform(0, 1)) : T(std::exp2(bits.uniform(-24, 0)));
        const long double exact =
            (1 - (long double)alpha) * (long double)below + (long double)alpha * (long double)above;
        largest = std::max(largest, double(std::abs((long double)over(below, above, alpha) - exact)) / u<T>);
    }
    CHECK(largest <= 2);
    CHECK(largest > 1);
}

TEST_CASE_TEMPLATE("the roundings of blends are at least those that are left, and at most 1.16 times as many", T, float,
                   double)
{
    bit_source bits(3);
    for (std::int64_t i = 0; i < effort(20'000); ++i) {
        const T alpha = T(std::exp2(bits.uniform(-10, 0)));
        const std::size_t layers = 1 + bits.below(3000);
        double left = 0;
        for (std::size_t k = 0; k < layers; ++k) left = left * (1 - double(alpha)) + 1;
        const double stated = double(blend_roundings_of_layers(alpha, T(layers)));
        REQUIRE(left <= stated * (1 + 8 * u<T>)+1e-9);
        REQUIRE(stated <= 1.16 * left);
        REQUIRE(stated <= double(blend_roundings(alpha)));
    }
    CHECK(blend_roundings(T(0.25)) == 4);
    CHECK(blend_roundings(T(2)) == 1);
    CHECK(blend_roundings(T(0)) == T(0x1p24));
    CHECK(blend_roundings(nan_of<T>) == T(0x1p24));
    CHECK(blend_roundings_of_layers(T(0.25), nan_of<T>) == 4);
    CHECK(blend_roundings_of_layers(T(0.25), T(-3)) == 1);
    CHECK(blend_roundings_of_layers(T(0.25), std::numeric_limits<T>::infinity()) == 4);
    CHECK(blend_roundings(T(alpha_test_one_percent)) == doctest::Approx(100));
}
