// Four moments never darken: for any distribution on [-1, 1] and any receiver,
//     intensity <= Z(z < z_f) + the stated weight of the format and of the route to the intensity
// after one rounding in storage, and after two filter passes that round to the format again. A hill climber searches
// for the largest darkness, and for the largest errors that hamburger4.h and storage/moments4.h state.
#include "evaluation/methods/raised_pivots4.hpp"
#include "support/climber.hpp"
#include "support/contacts.hpp"
#include "support/moments_of.hpp"
#include "support/statistics.hpp"
#include "support/truncated_half.hpp"

#include <gnomon/storage/formats.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <type_traits>

using namespace gnomon;
using namespace gnomon::test;

namespace {

using channels = channels4<float>;

/// The channels of a distribution, rounded to the format.
template <class Format> channels stored(const distribution& d)
{
    return Format::decode(Format::encode(Format::from_moments(moments4_of(d))));
}

constexpr std::int64_t evaluations = 200'000;

/// The largest intensity - Z(z < z_f) after one rounding. The search ends above `enough`.
template <class Format, class Intensity>
double darkest_once(std::int64_t count, Intensity intensity, double enough = HUGE_VAL)
{
    return climb(sight_dimensions, count, 1,
                 [&](const std::vector<double>& place) {
                     const sight s = sight_at(place);
                     const double shown = double(intensity(stored<Format>(s.seen), float(s.receiver)));
                     const double darkness = shown - s.seen.below(s.receiver);
                     return darkness > enough ? HUGE_VAL : darkness;
                 })
        .score;
}

/// The largest intensity - Z(z < z_f) of a mixture of texels that are stored once, as a texture unit returns it: in float.
template <class Format, class Intensity> double darkest_mixed(std::int64_t count, Intensity intensity)
{
    return climb(sight_dimensions, count, 4,
                 [&](const std::vector<double>& place) {
                     const sight s = sight_at(place);
                     return double(intensity(mixed_channels<Format>(s.seen), float(s.receiver))) -
                            s.seen.below(s.receiver);
                 })
        .score;
}

/// The largest intensity - Z(z < z_f) after two filter passes.
template <class Format, class Intensity> double darkest_filtered(std::int64_t count, Intensity intensity)
{
    return climb(contact_dimensions, count, 2,
                 [&](const std::vector<double>& place) {
                     const contact s = contact_at(place);
                     return double(intensity(filtered_channels<Format>(s), float(s.receiver))) - s.below(s.receiver);
                 })
        .score;
}

template <class Format> void report(const char* route, double darkness, double weight)
{
    std::printf("%s, %s: darkness %.3g of %.3g\n", std::string(Format::name).c_str(), route, darkness, weight);
    CHECK(darkness <= weight);
}

} // namespace

TEST_CASE_TEMPLATE("a lit surface is never darkened", Format, moments4_unorm16, moments4_half, moments4_float)
{
    const auto once = [](channels c, float z_f) { return Format::intensity(c, z_f); };
    const auto passes = [](channels c, float z_f) { return Format::filtered_intensity(c, z_f); };
    report<Format>("certified, one rounding", darkest_once<Format>(evaluations, once), Format::darkening);
    // A mixture of floats rounds once more, for which one rounding does not allow.
    constexpr bool rounds_again = std::is_same_v<Format, moments4_float>;
    report<Format>("certified, texture unit",
                   rounds_again ? darkest_mixed<Format>(evaluations, passes) : darkest_mixed<Format>(evaluations, once),
                   rounds_again ? Format::filtered_darkening : Format::darkening);
    report<Format>("certified, two filter passes", darkest_filtered<Format>(evaluations, passes),
                   Format::filtered_darkening);
    const auto constant = [](channels c, float z_f) { return hamburger4_lower(Format::factor(c), z_f); };
    const auto constant_passes = [](channels c, float z_f) {
        return hamburger4_lower(Format::filtered_factor(c), z_f);
    };
    report<Format>("constant bias, one rounding", darkest_once<Format>(evaluations, constant),
                   Format::bias_weight + stored4_arithmetic_weight);
    report<Format>("constant bias, two filter passes", darkest_filtered<Format>(evaluations, constant_passes),
                   Format::filtered_bias_weight + stored4_arithmetic_weight);
}

TEST_CASE("half floats that are truncated darken no lit surface")
{
    using format = truncated_half;
    CHECK(half_decode(format::encode({0.3f, 0, 0, 0})[0]) < 0.3f);
    CHECK(half_decode(format::encode({-0.3f, 0, 0, 0})[0]) > -0.3f);
    report<format>("truncated, texture unit",
                   darkest_mixed<format>(evaluations, [](channels c, float z_f) { return format::intensity(c, z_f); }),
                   format::darkening);
    report<format>(
        "truncated, two filter passes",
        darkest_filtered<format>(evaluations, [](channels c, float z_f) { return format::filtered_intensity(c, z_f); }),
        format::filtered_darkening);
    report<format>(
        "truncated, constant bias, two filter passes",
        darkest_filtered<format>(
            evaluations, [](channels c, float z_f) { return hamburger4_lower(format::filtered_factor(c), z_f); }),
        format::filtered_bias_weight + stored4_arithmetic_weight);
}

// A certificate with nodes that noise has misplaced proves little and would be a lit speck in a shadow. The constant
// bias has no such specks.
TEST_CASE_TEMPLATE("certified contact shadows have no lit specks", Format, moments4_unorm16, moments4_half,
                   moments4_float)
{
    bit_source bits(5);
    int specks = 0;
    for (int i = 0; i < 20'000; ++i) {
        std::vector<double> place(contact_dimensions);
        for (double& x : place) x = bits.uniform(0, 1);
        const contact s = contact_at(place);
        const channels c = filtered_channels<Format>(s);
        const float z_f = float(s.receiver);
        const float constant = hamburger4_lower(Format::filtered_factor(c), z_f);
        specks += Format::filtered_intensity(c, z_f) < constant - 0.2f;
    }
    CHECK(specks == 0);
}

TEST_CASE_TEMPLATE("the climber finds that raised pivots darken", Format, moments4_unorm16, moments4_half,
                   moments4_float)
{
    const auto darkening = [](channels c, float z_f) {
        return hamburger4_lower(bench::hankel4_raised_from(Format{}, c), z_f);
    };
    CHECK(darkest_once<Format>(100 * evaluations, darkening, 0.05) > 0.05);
}

namespace {

/// Checks the row of the header against the largest error(channels, z_f) that a search finds over distributions in
/// Format, where error compares float with double.
template <class Format, class Error> void climb_error(const char* header, const std::string& name, Error error)
{
    const summit top = climb(sight_dimensions, evaluations, 3, [&](const std::vector<double>& place) {
        const sight s = sight_at(place);
        return error(stored<Format>(s.seen), float(s.receiver));
    });
    const double stated = stated_error(header, name).maximum;
    std::printf("%s: error %.3g of %.3g\n", name.c_str(), top.score, stated);
    CHECK(top.score <= stated);
}

template <class Format, class Factor> void climb_bounds(const std::string& name, Factor factor)
{
    climb_error<Format>("moments/hamburger4.h", "float, " + name, [&](const channels& c, float z_f) {
        const hamburger_bounds<float> r = hamburger4_bounds(factor(c), z_f);
        const hamburger_bounds<double> exact = hamburger4_bounds(factor(in_double(c)), double(z_f));
        return std::max(std::abs(double(r.lower) - exact.lower), std::abs(double(r.upper) - exact.upper));
    });
}

/// Checks the row of a certificate, with its quantiles over the families.
template <class Format, class Intensity> void check_certified(const std::string& name, Intensity intensity)
{
    const auto error = [&](const channels& c, float z_f) {
        return std::abs(double(intensity(c, z_f)) - intensity(in_double(c), double(z_f)));
    };
    climb_error<Format>("storage/moments4.h", "float, " + name, error);
    error_sample sample;
    distribution_source source(20170101);
    for (int f = 0; f < family_count; ++f)
        for (int i = 0; i < 2000; ++i) {
            const distribution d = source.draw(family(f));
            sample.add(error(stored<Format>(d), float(source.receiver(d))));
        }
    const error_row row = stated_error("storage/moments4.h", "float, " + name);
    CHECK(sample.quantile(0.99) <= row.p99);
    CHECK(sample.quantile(0.999) <= row.p999);
}

} // namespace

TEST_CASE("four moments in float have their stated errors where a climb finds the largest")
{
    climb_bounds<moments4_float>("hankel4_from_float", [](auto b) { return hankel4_from_float(b); });
    climb_bounds<moments4_float>("hankel4_from_float_filtered", [](auto b) { return hankel4_from_float_filtered(b); });
    climb_bounds<moments4_half>("hankel4_from_half", [](auto b) { return hankel4_from_half(b); });
    climb_bounds<moments4_half>("hankel4_from_half_filtered", [](auto b) { return hankel4_from_half_filtered(b); });
    climb_bounds<moments4_unorm16>("hankel4_from_unorm16", [](auto c) { return hankel4_from_unorm16(c); });
    climb_bounds<moments4_unorm16>("hankel4_from_unorm16_filtered",
                                   [](auto c) { return hankel4_from_unorm16_filtered(c); });
    check_certified<moments4_float>("moments4_float_intensity",
                                    [](auto b, auto z) { return moments4_float_intensity(b, z); });
    check_certified<moments4_float>("moments4_float_filtered_intensity",
                                    [](auto b, auto z) { return moments4_float_filtered_intensity(b, z); });
    check_certified<moments4_half>("moments4_half_intensity",
                                   [](auto b, auto z) { return moments4_half_intensity(b, z); });
    check_certified<moments4_half>("moments4_half_filtered_intensity",
                                   [](auto b, auto z) { return moments4_half_filtered_intensity(b, z); });
    check_certified<moments4_unorm16>("moments4_unorm16_intensity",
                                      [](auto c, auto z) { return moments4_unorm16_intensity(c, z); });
    check_certified<moments4_unorm16>("moments4_unorm16_filtered_intensity",
                                      [](auto c, auto z) { return moments4_unorm16_filtered_intensity(c, z); });
}

namespace {

/// Two depths in contact, the receiver on the second, and the intensity that raised pivots show there, which is far
/// above the truth, the weight of the first.
struct finding {
    double first, weight, second, shows;
};

template <class Format> void check_finding(const finding& f)
{
    const float z_f = float(f.second);
    const channels c = stored<Format>({{double(float(f.first)), double(z_f)}, {f.weight, 1 - f.weight}});
    CHECK(double(hamburger4_lower(bench::hankel4_raised_from(Format{}, c), z_f)) ==
          doctest::Approx(f.shows).epsilon(0.02));
    CHECK(double(Format::intensity(c, z_f)) <= f.weight + Format::darkening);
    CHECK(double(hamburger4_lower(Format::factor(c), z_f)) <=
          f.weight + Format::bias_weight + stored4_arithmetic_weight);
}

} // namespace

TEST_CASE("no route of the library darkens the contacts that raised pivots darken")
{
    check_finding<moments4_unorm16>({-0.731, 0.125, -0.711, 0.889});
    check_finding<moments4_half>({-0.76, 0.125, -0.687, 0.865});
    check_finding<moments4_float>({0.9467, 0.25, 0.9477, 0.619});
}
