// Absorbance moments: transmittance from sums over fragments in any order, against products in double; never darker than the
// stack, from maps too, for which a hill climber searches the largest darkness; coloured fragments; bad input.
#include "support/climber.hpp"
#include "support/contacts.hpp"
#include "support/rounding.hpp"
#include "support/stacks.hpp"

#include <gnomon/moments/absorbance.h>
#include <gnomon/passes/blend.hpp>
#include <gnomon/storage/absorbance4.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

/// Fragments of a stack, and what is left of the light before z_f.
struct fragments {
    std::vector<double> depths, alphas;

    [[nodiscard]] double transmittance(double z_f) const
    {
        double left = 1;
        for (std::size_t k = 0; k < depths.size(); ++k) left *= depths[k] < z_f ? 1 - alphas[k] : 1;
        return left;
    }
};

/// Fragments in any order, with opacities below 1 - e^-16.
fragments any_fragments(bit_source& bits)
{
    const stack s = any_stack(bits);
    fragments f{s.depths, s.alphas};
    for (std::size_t k = f.depths.size(); k > 1; --k) {
        const std::size_t other = bits.below(k);
        std::swap(f.depths[k - 1], f.depths[other]);
        std::swap(f.alphas[k - 1], f.alphas[other]);
    }
    for (double& alpha : f.alphas) alpha = std::min(alpha, 1 - 1e-6);
    return f;
}

absorbance4<double> sum_of(const fragments& f)
{
    absorbance4<double> sum{};
    for (std::size_t k = 0; k < f.depths.size(); ++k)
        sum = absorbance4_add(sum, absorbance4_of_fragment(f.depths[k], f.alphas[k]));
    return sum;
}

/// The channels of fragments that were added to one texel of the format.
template <class Format> format_channels<Format> accumulated(const fragments& f)
{
    std::array<format_texel<Format>, 1> texel{Format::clear()};
    for (std::size_t k = 0; k < f.depths.size(); ++k) {
        const translucent_fragment one{0, 0, float(f.depths[k]), float(f.alphas[k])};
        accumulate<Format>({texel, 1, 1}, std::span(&one, 1));
    }
    return Format::decode(texel[0]);
}

constexpr std::size_t groups = 3, dimensions = 4 * groups + 3;

/// A receiver and up to three groups of fragments that are alike, a group from its neighbour's depth or anywhere.
struct absorbing_sight {
    fragments seen;
    double receiver;
};

absorbing_sight sight_of_fragments(const std::vector<double>& x)
{
    absorbing_sight s;
    double z = 0;
    for (std::size_t g = 0; g < groups; ++g) {
        const double* place = &x[4 * g];
        z = place[0] > 0.5 ? z - any_size(2 * place[0] - 1, 30) : 4.4 * place[0] - 1.1;
        const double step = place[3] < 0.3 ? 0 : std::exp2(-24 * place[3]);
        for (std::size_t n = 1 + std::size_t(20 * place[2]); n > 0; --n, z -= step) {
            s.seen.depths.push_back(clamped_depth(z));
            s.seen.alphas.push_back(double(float(std::exp2(-9 * place[1]))));
        }
    }
    const double* rest = &x[4 * groups];
    const std::size_t count = s.seen.depths.size();
    s.receiver =
        receiver_at(s.seen.depths[std::min(std::size_t(double(count) * rest[0]), count - 1)], rest[1], rest[2]);
    return s;
}

} // namespace

TEST_CASE("transmittance lies within the bounds, in any order, and is exact before and behind all fragments")
{
    bit_source bits(1);
    for (std::int64_t i = 0; i < effort(20'000); ++i) {
        const fragments f = any_fragments(bits);
        const absorbance4<double> b = sum_of(f);
        const double z_f =
            !f.depths.empty() && bits.chance(0.3) ? f.depths[bits.below(f.depths.size())] : bits.uniform(-1, 1);
        const double alpha = 1e-9, exact = f.transmittance(z_f);
        const double most = absorbance4_transmittance(b, alpha, 1.0, z_f),
                     least = absorbance4_transmittance(b, alpha, 0.0, z_f),
                     middle = absorbance4_transmittance(b, alpha, 0.5, z_f);
        // A bias of alpha moves bounds by alpha, which b0 multiplies.
        const double allowed = 4 * alpha * (1 + b.b0);
        REQUIRE(exact <= most + 1e-9);
        REQUIRE(least <= exact + allowed);
        REQUIRE(least <= middle);
        REQUIRE(middle <= most);
        REQUIRE(absorbance_transmittance(b.b0, 1.0) == doctest::Approx(f.transmittance(2)).epsilon(1e-6));
        REQUIRE(absorbance_transmittance(b.b0, 0.0) == 1);
    }
}

TEST_CASE_TEMPLATE("accumulated fragments never darken a surface more than b0 is rounded", Format, absorbance4_float,
                   absorbance4_half)
{
    // Of a sum b0 that is off by a relative e, exp(-b0) is off by e b0 exp(-b0) <= e / 2.718; rounded, not truncated.
    const double each = std::is_same_v<Format, absorbance4_half> ? 0x1p-11 : 0x1p-24;
    const summit top = climb(dimensions, 150'000, 1, [&](const std::vector<double>& place) {
        const absorbing_sight s = sight_of_fragments(place);
        const auto n = float(s.seen.depths.size());
        const double shown = double(Format::transmittance(accumulated<Format>(s.seen), n, 1.0f, float(s.receiver)));
        return s.seen.transmittance(s.receiver) - shown - double(n) * each / 2.718;
    });
    const double allowed = std::is_same_v<Format, absorbance4_half> ? double(absorbance4_half_least) : 1e-6;
    std::printf("%s: darkness %.3g of %.3g\n", std::string(Format::id).c_str(), top.score, allowed);
    CHECK(top.score <= allowed);
}

TEST_CASE("the climber finds that a bias which is not taken off darkens")
{
    const summit top = climb(dimensions, 150'000, 2, [](const std::vector<double>& place) {
        const absorbing_sight s = sight_of_fragments(place);
        const absorbance4<double> b = sum_of(s.seen);
        const double alpha = 0.01;
        const auto bounds = hamburger4_bounds(absorbance4_factor(b, alpha), s.receiver);
        return s.seen.transmittance(s.receiver) - absorbance_transmittance(b.b0, bounds.lower);
    });
    CHECK(top.score > 0.02);
}

TEST_CASE_TEMPLATE("absorbance and transmittance have their stated errors", T, float, double)
{
    bit_source bits(3);
    double absorbed = 0, passed = 0, weight = 0;
    for (std::int64_t i = 0; i < effort(200'000); ++i) {
        const T alpha = T(bits.chance(0.5) ? bits.uniform(0, 1) : std::exp2(bits.uniform(-20, 0)));
        if (alpha < T(1 - 1.2e-7)) {
            const long double exact = -std::log1p(-(long double)alpha);
            if (exact < 16)
                absorbed = std::max(absorbed, double(std::abs((long double)absorbance_of_opacity(alpha) - exact) *
                                                     (1 - (long double)alpha)) /
                                                  u<T>);
        }
        const T b0 = T(std::exp2(bits.uniform(-10, 6))), intensity = T(bits.uniform(0, 1));
        const long double product = (long double)b0 * (long double)intensity, exact = std::exp(-product);
        passed = std::max(passed, double(std::abs((long double)absorbance_transmittance(b0, intensity) - exact) /
                                         exact / (2 + 2 * product)) /
                                      u<T>);
        const T w = T(std::exp2(bits.uniform(-26, 0))), n = T(std::exp2(bits.uniform(0, 12)));
        const long double nw = (long double)n * (long double)w, right = nw / (1 - (long double)w + nw);
        weight = std::max(weight, double(std::abs((long double)bias_weight_of_roundings(w, n) - right) / right) / u<T>);
    }
    CHECK(absorbed <= 2);
    CHECK(passed <= 1);
    CHECK(weight <= 4);
}

TEST_CASE_TEMPLATE("bad input lets light through", T, float, double)
{
    const T nan = std::numeric_limits<T>::quiet_NaN(), infinity = std::numeric_limits<T>::infinity();
    for (const T none : {T(0), T(-1), -infinity, nan}) CHECK(absorbance_of_opacity(none) == 0);
    for (const T all : {T(1), T(2), infinity}) CHECK(absorbance_of_opacity(all) == T(absorbance_most));
    CHECK(absorbance_transmittance(nan, T(0.5)) == 1);
    CHECK(absorbance_transmittance(T(3), nan) == 1);
    CHECK(absorbance_transmittance(T(-3), T(1)) == 1);
    CHECK(absorbance_transmittance(infinity, T(0)) == 1);
    CHECK(absorbance4_transmittance(absorbance4<T>{}, T(1e-5), T(1), T(0)) == 1);
    const auto unknown = absorbance4_of_fragment(nan, T(0.5));
    CHECK(unknown.b1 == unknown.b0);
    const auto smoke = absorbance4_of_fragment(T(-0.5), T(0.5));
    CHECK(absorbance4_transmittance(smoke, T(1e-5), T(1), nan) == 1);
    CHECK(transmitted_intensity(T(0.5), T(0.5)) == T(0.75));
    CHECK(transmitted_intensity(nan, T(0.5)) == T(0.5));
    CHECK(transmitted_intensity(T(0.5), nan) == T(0.5));
    CHECK(transmitted_intensity(T(1), T(0.5)) == 1);
    CHECK(transmitted_intensity(T(-3), T(3)) == 0);
    CHECK(transmitted_intensity(T(3), T(-3)) == 1);
}

TEST_CASE("coloured fragments: those of equal channels as grey ones, others right in front of all and behind all")
{
    bit_source bits(4);
    for (std::int64_t i = 0; i < effort(5'000); ++i) {
        const double alpha = 1e-7;
        std::array<double, 3> left{1, 1, 1};
        coloured_absorbance4<double> sum{}, grey{};
        absorbance4<double> plain{};
        for (std::size_t n = 1 + bits.below(8); n > 0; --n) {
            const double z = bits.uniform(-0.5, 0.5), r = bits.uniform(0, 0.9), g = bits.uniform(0, 0.9), b = r * g;
            sum = coloured_absorbance4_add(sum, coloured_absorbance4_of_fragment(z, r, g, b));
            grey = coloured_absorbance4_add(grey, coloured_absorbance4_of_fragment(z, r, r, r));
            plain = absorbance4_add(plain, absorbance4_of_fragment(z, r));
            left = {left[0] * (1 - r), left[1] * (1 - g), left[2] * (1 - b)};
        }
        const double z_f = bits.uniform(-1, 1);
        const auto t = coloured_absorbance4_transmittance(grey, alpha, 1.0, z_f);
        const double same = absorbance4_transmittance(plain, alpha, 1.0, z_f);
        for (const double channel : {t.red, t.green, t.blue}) REQUIRE(channel == doctest::Approx(same).epsilon(1e-3));
        const auto before = coloured_absorbance4_transmittance(sum, alpha, 1.0, -1.0);
        const auto behind = coloured_absorbance4_transmittance(sum, alpha, 0.5, 1.0);
        REQUIRE(before.red == 1);
        REQUIRE(behind.red == doctest::Approx(left[0]).epsilon(0.15));
        REQUIRE(behind.green == doctest::Approx(left[1]).epsilon(0.15));
        REQUIRE(behind.blue == doctest::Approx(left[2]).epsilon(0.15));
    }
}

TEST_CASE("a filter over absorbances is darker than the mean transmittance: opaque occluders need a map of their own")
{
    const absorbance4<double> opaque = absorbance4_of_fragment(-0.5, 1.0), thin = absorbance4_of_fragment(-0.5, 0.1);
    const auto half_covered = [](absorbance4<double> b) {
        b = {b.b0 / 2, b.b1 / 2, b.b2 / 2, b.b3 / 2, b.b4 / 2};
        return absorbance4_transmittance(b, 1e-9, 1.0, 0.5);
    };
    CHECK(half_covered(opaque) < 0.001); // 0.5 by percentage-closer filtering
    CHECK(half_covered(thin) == doctest::Approx(0.95).epsilon(0.002));
    CHECK(half_covered(thin) < 0.95);
}
