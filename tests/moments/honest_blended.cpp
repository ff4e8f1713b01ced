// Blended fragments never darken: for any stack over any surface, and any receiver,
//     intensity <= Z(z < z_f) + the stated weight of the route for the roundings that blends leave
// after the blends in the storage format, and after two filter passes that round to the format again. A hill climber searches
// for the largest darkness.
#include "support/climber.hpp"
#include "support/contacts.hpp"
#include "support/stacks.hpp"
#include "support/truncated_half.hpp"

#include <gnomon/passes/blend.hpp>
#include <gnomon/storage/formats.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <type_traits>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

/// A receiver and two stacks under a filter of two taps.
struct blended_sight {
    std::array<stack, 2> stacks;
    std::array<float, 2> taps;
    double receiver = 0;

    [[nodiscard]] double below(double z_f) const
    {
        double sum = 0;
        for (std::size_t i = 0; i < 2; ++i) sum += double(taps[i]) * (1 - stacks[i].transmittance(z_f));
        return sum / (double(taps[0]) + double(taps[1]));
    }
};

constexpr std::size_t group_count = 3, blended_dimensions = 2 + 4 * group_count + 5;

/// Stacks of up to three groups of fragments that are alike: each has a depth, from its neighbour's or anywhere, an
/// opacity from 2^-7 on, up to 60 fragments, and the distance between these. The second stack has those of the first but for
/// the nearest group.
blended_sight sight_of_stacks(const std::vector<double>& x)
{
    blended_sight s;
    stack& first = s.stacks[0];
    double z = first.behind = clamped_depth(2.2 * x[0] - 1.1);
    for (std::size_t g = 0; g < group_count; ++g) {
        const double* place = &x[2 + 4 * g];
        z -= place[0] > 0.5 ? std::exp2(-30 * (2 * place[0] - 1)) : 2 * place[0];
        const double alpha = double(float(std::exp2(-7 * place[1])));
        const double step = place[3] < 0.3 ? 0 : std::exp2(-24 * place[3]);
        if (g + 1 == group_count) s.stacks[1] = first;
        for (std::size_t n = std::size_t(61 * place[2]); n > 0; --n, z -= step) {
            first.depths.push_back(clamped_depth(z));
            first.alphas.push_back(alpha);
        }
    }
    const double* rest = &x[2 + 4 * group_count];
    s.taps = {float(1 - 0.5 * x[1]), float(0.5 * x[1])};
    const std::size_t chosen = std::min(std::size_t(double(first.size() + 1) * rest[0]), first.size());
    s.receiver = receiver_at(chosen == 0 ? first.behind : first.depths[chosen - 1], rest[1], rest[2]);
    return s;
}

/// The texel of a stack, blended in the format.
template <class Format> format_texel<Format> blended_texel(const stack& s)
{
    std::array<format_texel<Format>, 1> texel{Format::encode(Format::from_depth(float(s.behind)))};
    for (std::size_t k = 0; k < s.size(); ++k) {
        const translucent_fragment f{0, 0, float(s.depths[k]), float(s.alphas[k])};
        blend<Format>({texel, 1, 1}, std::span(&f, 1));
    }
    return texel[0];
}

/// The channels of the first stack, or of both after two filter passes.
template <class Format> format_channels<Format> seen(const blended_sight& s, bool filtered)
{
    auto c = load_channels<Format>(blended_texel<Format>(s.stacks[0]));
    const auto other = load_channels<Format>(blended_texel<Format>(s.stacks[1]));
    for (int pass = 0; filtered && pass < 2; ++pass) {
        for (std::size_t k = 0; k < c.size(); ++k) c[k] = s.taps[0] * c[k] + s.taps[1] * (pass == 0 ? other[k] : c[k]);
        c = load_channels<Format>(store_channels<Format>(c));
    }
    return gnomon_bit_cast<format_channels<Format>>(c);
}

/// The roundings that blends of both stacks leave, from the least opacity and the number of layers.
float roundings_of(const blended_sight& s)
{
    double least = 1;
    for (const stack& t : s.stacks)
        for (const double alpha : t.alphas) least = std::min(least, alpha);
    const std::size_t layers = s.stacks[0].size();
    return layers == 0 ? 0 : blend_roundings_of_layers(float(least), float(layers));
}

constexpr std::int64_t evaluations = 60'000;

/// The largest intensity - Z(z < z_f) - weight(roundings). The search ends above `enough`.
template <class Format, class Intensity, class Weight>
double darkest(bool filtered, std::int64_t count, Intensity intensity, Weight weight, double enough = HUGE_VAL)
{
    return climb(blended_dimensions, count, filtered ? 2 : 1,
                 [&](const std::vector<double>& place) {
                     const blended_sight s = sight_of_stacks(place);
                     const float roundings = roundings_of(s) + (filtered ? 2.0f : 0.0f);
                     const auto c = seen<Format>(s, filtered);
                     const double truth = filtered ? s.below(s.receiver) : 1 - s.stacks[0].transmittance(s.receiver);
                     const double darkness = double(intensity(c, roundings, float(s.receiver))) - truth;
                     return darkness > enough ? HUGE_VAL : darkness - weight(roundings);
                 })
        .score;
}

template <class Format> void report(const char* route, double excess)
{
    std::printf("%s, %s: darkness %.3g above the weight\n", std::string(Format::id).c_str(), route, excess);
    CHECK(excess <= 0);
}

template <class Format> constexpr double each_rounding = 1;
template <> constexpr double each_rounding<moments4_half> = blended_half_roundings;
template <> constexpr double each_rounding<truncated_half> = blended_half_roundings;
template <> constexpr double each_rounding<moments4_float> = blended_float_roundings;
template <> constexpr double each_rounding<moments6_float> = blended6_float_weights;

template <class Format> auto blended_lower(const format_channels<Format>& c, float roundings, float z_f)
{
    if constexpr (channel_count<Format> == 4) return hamburger4_lower(Format::blended_factor(c, roundings), z_f);
    else return hamburger6_lower(Format::blended_factor(c, roundings), z_f);
}

} // namespace

TEST_CASE_TEMPLATE("a lit surface is never darkened by blended fragments", Format, moments4_unorm16, moments4_half,
                   truncated_half, moments4_float, moments6_unorm10, moments6_unorm16, moments6_float)
{
    const auto constant_weight = [](float roundings) {
        const double n = 1 + each_rounding<Format> * double(roundings);
        return bias_weight_of_roundings(Format::bias_weight, n) + stored4_arithmetic_weight;
    };
    for (const bool filtered : {false, true}) {
        if constexpr (channel_count<Format> == 4)
            report<Format>(filtered ? "certified, filtered" : "certified",
                           darkest<Format>(
                               filtered, evaluations,
                               [](const auto& c, float n, float z_f) { return Format::blended_intensity(c, n, z_f); },
                               [](float) { return stored4_arithmetic_weight; }));
        report<Format>(filtered ? "constant bias, filtered" : "constant bias",
                       darkest<Format>(filtered, evaluations, blended_lower<Format>, constant_weight));
    }
}

TEST_CASE_TEMPLATE("the climber finds that intensities for few roundings darken blended fragments", Format,
                   moments4_unorm16, moments4_half, moments4_float, moments6_unorm10, moments6_unorm16, moments6_float)
{
    const auto darkness = darkest<Format>(
        false, 100 * evaluations, [](const auto& c, float, float z_f) { return Format::filtered_intensity(c, z_f); },
        [](float) { return 0.0; }, 0.05);
    CHECK(darkness > 0.05);
}

// Channels that blends leave behind are too far, not too near, so the minimum variance for three roundings suffices.
TEST_CASE("variance darkens no lit surface by more than 1% after blends")
{
    using format = variance_unorm16;
    const summit top = climb(blended_dimensions, 5 * evaluations, 5, [](const std::vector<double>& place) {
        const blended_sight s = sight_of_stacks(place);
        if (s.stacks[0].transmittance(s.receiver) < 1) return -1.0; // no bound within its roundings elsewhere
        return double(format::intensity(seen<format>(s, false), float(s.receiver)));
    });
    std::printf("%s: darkness %.3g\n", std::string(format::id).c_str(), top.score);
    CHECK(top.score <= double(format::darkening));
}

TEST_CASE("without blends the intensities are those of one rounding")
{
    bit_source bits(4);
    for (int i = 0; i < 1000; ++i) {
        const auto four = theta4(moments4_from_depth(float(bits.uniform(-1, 1))));
        const float z_f = float(bits.uniform(-1, 1));
        CHECK(double(moments4_unorm16_blended_intensity(four, 0, z_f)) ==
              doctest::Approx(double(moments4_unorm16_intensity(four, z_f))).epsilon(1e-4));
        CHECK(moments4_unorm16_blended_intensity(four, -5, z_f) == moments4_unorm16_blended_intensity(four, 0, z_f));
    }
    CHECK(bias_weight_of_roundings(0.25, 1.0) == 0.25);
    CHECK(bias_weight_of_roundings(0.25, 3.0) == doctest::Approx(0.5));
    // As moments6_blended.h and docs/translucency.md state, of an alpha from 1% on.
    const double n = 1 + blend_roundings(alpha_test_one_percent);
    CHECK(bias_weight_of_roundings(stored6_unorm16_weight, n) == doctest::Approx(8e-3).epsilon(0.01));
    CHECK(bias_weight_of_roundings(stored6_unorm10_weight, n) == doctest::Approx(0.29).epsilon(0.01));
}

TEST_CASE("no number of roundings is too large: the shadow fades")
{
    const auto c = theta4(moments4_from_depth(-0.5f));
    float last = 2;
    for (const float n : {1e0f, 1e2f, 1e4f, 1e6f, 1e10f, 1e38f, HUGE_VALF, std::nanf("")}) {
        const float shadow = moments4_unorm16_blended_intensity(c, n, 0.5f);
        CHECK(shadow <= last);
        last = shadow;
    }
    CHECK(last == 0);
}
