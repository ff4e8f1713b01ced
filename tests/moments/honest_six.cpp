// Six moments never darken: for any distribution on [-1, 1] and any receiver,
//     intensity <= Z(z < z_f) + the weight of the format
// after one rounding in storage, and after two filter passes that round to the format again. A hill climber searches
// for the largest darkness, and for the largest errors that hamburger6.h states.
#include "evaluation/methods/raised_pivots6.hpp"
#include "support/climber.hpp"
#include "support/contacts.hpp"
#include "support/moments_of.hpp"
#include "support/statistics.hpp"

#include <gnomon/storage/formats.hpp>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <doctest/doctest.h>

#include <cstdio>
#include <string>

using namespace gnomon;
using namespace gnomon::test;

namespace {

/// The channels of a distribution, rounded to the format.
template <class Format> channels6<float> stored(const distribution& d)
{
    return Format::decode(Format::encode(Format::from_moments(moments6_of(d))));
}

template <class Format> struct stored_once {
    using format = Format;
    static constexpr auto what = "one rounding";
    static constexpr std::size_t dimensions = sight_dimensions;

    /// The excess intensity - Z(z < z_f).
    template <class Factor> static double darkness(const std::vector<double>& place, Factor factor)
    {
        const sight s = sight_at(place);
        const float intensity = hamburger6_lower(factor(stored<format>(s.seen)), float(s.receiver));
        return double(intensity) - s.seen.below(s.receiver);
    }
};

template <class Format> struct filtered_twice {
    using format = Format;
    static constexpr auto what = "two filter passes";
    static constexpr std::size_t dimensions = contact_dimensions;

    template <class Factor> static double darkness(const std::vector<double>& place, Factor factor)
    {
        const contact s = contact_at(place);
        const float intensity = hamburger6_lower(factor(filtered_channels<format>(s)), float(s.receiver));
        return double(intensity) - s.below(s.receiver);
    }
};

struct float_once : stored_once<moments6_float> {
    static constexpr double weight = stored6_float_weight;
    static hankel6<float> factor(channels6<float> c) { return hankel6_from_float(c); }
};
struct float_filtered : filtered_twice<moments6_float> {
    static constexpr double weight = stored6_float_filtered_weight;
    static hankel6<float> factor(channels6<float> c) { return hankel6_from_float_filtered(c); }
};
struct unorm16_once : stored_once<moments6_unorm16> {
    static constexpr double weight = stored6_unorm16_weight;
    static hankel6<float> factor(channels6<float> c) { return hankel6_from_unorm16(c); }
};
struct unorm16_filtered : filtered_twice<moments6_unorm16> {
    static constexpr double weight = stored6_unorm16_filtered_weight;
    static hankel6<float> factor(channels6<float> c) { return hankel6_from_unorm16_filtered(c); }
};
struct unorm10_once : stored_once<moments6_unorm10> {
    static constexpr double weight = stored6_unorm10_weight;
    static hankel6<float> factor(channels6<float> c) { return hankel6_from_unorm10(c); }
};
struct unorm10_filtered : filtered_twice<moments6_unorm10> {
    static constexpr double weight = stored6_unorm10_filtered_weight;
    static hankel6<float> factor(channels6<float> c) { return hankel6_from_unorm10_filtered(c); }
};

constexpr std::int64_t evaluations = 200'000;

/// Checks the row of the header against the largest difference of a bound in float from the bound in double that a
/// search finds over distributions in Format.
template <class Format, class Factor> void climb_error(const std::string& name, Factor factor)
{
    const summit top = climb(sight_dimensions, evaluations, 3, [&](const std::vector<double>& place) {
        const sight s = sight_at(place);
        const channels6<float> c = stored<Format>(s.seen);
        const hamburger_bounds<float> r = hamburger6_bounds(factor(c), float(s.receiver));
        const hamburger_bounds<double> exact = hamburger6_bounds(factor(in_double(c)), s.receiver);
        return std::max(std::abs(double(r.lower) - exact.lower), std::abs(double(r.upper) - exact.upper));
    });
    const double stated = stated_error("moments/hamburger6.h", name).maximum;
    std::printf("%s: error %.3g of %.3g\n", name.c_str(), top.score, stated);
    CHECK(top.score <= stated);
}

} // namespace

TEST_CASE_TEMPLATE("a lit surface is never darkened", Preset, float_once, float_filtered, unorm16_once,
                   unorm16_filtered, unorm10_once, unorm10_filtered)
{
    const summit top = climb(Preset::dimensions, evaluations, 1, [](const std::vector<double>& place) {
        return Preset::darkness(place, [](auto b) { return Preset::factor(b); });
    });
    std::printf("%s, %s: darkness %.3g of %.3g\n", std::string(Preset::format::name).c_str(), Preset::what, top.score,
                Preset::weight);
    CHECK(top.score <= Preset::weight);
}

TEST_CASE("the climber finds that raised pivots darken, and the weight for one rounding after three")
{
    const auto raised = [](auto c) {
        return bench::hankel6_raised(moments6_from_channels(c), float(bench::raised6_float_noise));
    };
    const auto float_unfiltered = [](auto b) { return hankel6_from_float(b); };
    const auto unorm10_unfiltered = [](auto c) { return hankel6_from_unorm10(c); };
    const auto darkest = [](auto preset, auto factor) {
        return climb(preset.dimensions, 2000 * evaluations, 2,
                     [&](const std::vector<double>& place) {
                         const double darkness = preset.darkness(place, factor);
                         return darkness > 0.05 ? HUGE_VAL : darkness; // enough
                     })
            .score;
    };
    CHECK(darkest(float_once(), raised) > 0.05);
    CHECK(darkest(float_filtered(), float_unfiltered) > 0.05);
    CHECK(darkest(unorm10_filtered(), unorm10_unfiltered) > 0.05);
}

// Depths are multiples of 1/64 and weights of 1/256, so six moments are exact in double. The tolerance is
// that of hamburger_bounds.cpp.
TEST_CASE("from exact moments in double, both bounds hold within 1e-9")
{
    const summit top = climb(16, 10 * evaluations, 4, [](const std::vector<double>& x) {
        const std::size_t count = 1 + std::min<std::size_t>(std::size_t(6 * x[0]), 5);
        distribution d;
        std::array<double, 7> cuts{};
        for (std::size_t i = 0; i < count; ++i) {
            d.depths.push_back(std::floor(128.999 * x[1 + i]) / 64 - 1);
            cuts[i] = i + 1 < count ? std::floor(256.999 * x[7 + i]) / 256 : 1;
        }
        std::sort(cuts.begin(), cuts.begin() + std::ptrdiff_t(count));
        for (std::size_t i = 0; i < count; ++i) d.weights.push_back(cuts[i] - (i > 0 ? cuts[i - 1] : 0));
        std::array<double, 6> b{};
        for (std::size_t i = 0; i < count; ++i) {
            double p = d.weights[i];
            for (double& moment : b) moment += p *= d.depths[i];
        }
        const double depth = d.depths[std::min(std::size_t(double(count) * x[13]), count - 1)];
        const double z_f =
            x[14] < 0.15 ? 2 * x[15] - 1 : std::clamp(depth + (x[14] < 0.3 ? 0 : any_size(x[15], 45)), -1.0, 1.0);
        double on_it = 0;
        for (std::size_t i = 0; i < count; ++i) on_it += d.depths[i] == z_f ? d.weights[i] : 0;
        const auto r = hamburger6_bounds(
            hankel6_constant_bias(moments6<double>{b[0], b[1], b[2], b[3], b[4], b[5]}, 0, 0, 0, 0), z_f);
        return std::max(r.lower - d.below(z_f), d.below(z_f) + on_it - r.upper);
    });
    std::printf("exact moments in double: outside by %.3g\n", top.score);
    CHECK(top.score <= 1e-9);
    // Depths -1/2 (weight 1/4) and 1, the receiver 2^-32 behind the first: a case for the Taylor shift in hamburger6.h.
    const auto pair =
        hankel6_constant_bias(moments6<double>{0.625, 0.8125, 0.71875, 0.765625, 0.7421875, 0.75390625}, 0, 0, 0, 0);
    CHECK(hamburger6_lower(pair, -0.5 + 0x1p-32) <= 0.25 + 1e-9);
}

// Low words may be as large as high words, as after a bias.
TEST_CASE("hankel6_minor has its stated error where a climb finds the largest")
{
    using high = boost::multiprecision::cpp_bin_float_50;
    const summit top = climb(8, evaluations / 4, 5, [](const std::vector<double>& x) {
        const auto word = [&](std::size_t k, double scale) {
            const double first = scale * (2 * x[k] - 1);
            return double_word<float>{float(first), float(first * any_size(x[k + 1], 30))};
        };
        const double_word<float> a = word(0, 1), b = word(2, 1), c = word(4, 0.1), d = word(6, 0.1);
        const auto product = [](double_word<float> p, double_word<float> q) {
            return high((high(p.high) + high(p.low)) * (high(q.high) + high(q.low)));
        };
        if (double(a.high) * double(b.high) < std::abs(double(c.high) * double(d.high))) return 0.0;
        const double_word<float> r = hankel6_minor(a, b, c, d);
        const high error = abs(high(r.high) + high(r.low) - (product(a, b) - product(c, d)));
        const auto share = [](double_word<float> p, double_word<float> q) {
            const double whole = std::abs(double(p.high) * double(q.high));
            const double lows = std::abs(double(p.high) * double(q.low)) +
                                std::abs(double(p.low)) * std::abs(double(q.high) + double(q.low));
            return whole * 0x1p-45 + lows * 0x1p-21;
        };
        const double allowed = share(a, b) + share(c, d);
        return allowed > 0x1p-100 ? double(error) / allowed : 0;
    });
    std::printf("hankel6_minor: %.3g of what is stated\n", top.score);
    CHECK(top.score <= 1);
    CHECK(top.score > 0.1);
}

TEST_CASE("six moments in float have their stated errors where a climb finds the largest")
{
    climb_error<moments6_float>("float, hankel6_constant_bias at 5e-6", [](auto c) {
        using T = decltype(c.c1);
        return hankel6_constant_bias(moments6_from_channels(c), T(bias6_raw_b2), T(bias6_raw_b4), T(bias6_raw_b6),
                                     T(5e-6f));
    });
    climb_error<moments6_float>("float, hankel6_from_float", [](auto b) { return hankel6_from_float(b); });
    climb_error<moments6_float>("float, hankel6_from_float_filtered",
                                [](auto b) { return hankel6_from_float_filtered(b); });
    climb_error<moments6_unorm16>("float, hankel6_from_unorm16", [](auto c) { return hankel6_from_unorm16(c); });
    climb_error<moments6_unorm16>("float, hankel6_from_unorm16_filtered",
                                  [](auto c) { return hankel6_from_unorm16_filtered(c); });
    climb_error<moments6_unorm10>("float, hankel6_from_unorm10", [](auto c) { return hankel6_from_unorm10(c); });
    climb_error<moments6_unorm10>("float, hankel6_from_unorm10_filtered",
                                  [](auto c) { return hankel6_from_unorm10_filtered(c); });
}
