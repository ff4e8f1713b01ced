// Certificates that know the least and greatest depth of a region beside its moments never darken. The second table
// of docs/decisions/2-bias.md states their gain: the mean of Z(z < z_f) - result over the receivers of leak_four.cpp,
// 4 x 16 UNORM.
#include "support/climber.hpp"
#include "support/contacts.hpp"
#include "support/documented.hpp"
#include "support/moments_of.hpp"
#include "support/oracle.hpp"

#include <gnomon/storage/formats.hpp>
#include <gnomon/storage/moments4_within.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdio>

using namespace gnomon;
using namespace gnomon::test;

namespace {

using channels = channels4<float>;

struct interval {
    float least, greatest;
};

/// The knowledge of the depths: only that they are in [-1, 1], or least and greatest depth as 8-bit codes or as floats.
enum knowledge { signed_depth, eight_bits, exact };

template <class Depths> interval known(knowledge k, const Depths& depths)
{
    const auto [least, greatest] = std::minmax_element(depths.begin(), depths.end());
    const auto code = [](double z, auto round) { return float(round((z + 1) * 127.5) / 127.5 - 1); };
    switch (k) {
        case signed_depth:
            return {-1, 1};
        case eight_bits:
            return {code(double(*least), [](double x) { return std::floor(x); }),
                    code(double(*greatest), [](double x) { return std::ceil(x); })};
        default:
            return {float(*least), float(*greatest)};
    }
}

float within(const moments4_unorm16&, const channels& c, interval i, float z_f)
{
    return moments4_unorm16_intensity_within(c, i.least, i.greatest, z_f);
}
float within(const moments4_half&, const channels& b, interval i, float z_f)
{
    return moments4_half_intensity_within(b, i.least, i.greatest, z_f);
}
float filtered_within(const moments4_unorm16&, const channels& c, interval i, float z_f)
{
    return moments4_unorm16_filtered_intensity_within(c, i.least, i.greatest, z_f);
}
float filtered_within(const moments4_half&, const channels& b, interval i, float z_f)
{
    return moments4_half_filtered_intensity_within(b, i.least, i.greatest, z_f);
}

} // namespace

TEST_CASE_TEMPLATE("a certificate with the depths of its region never darkens a lit surface", Format, moments4_unorm16,
                   moments4_half)
{
    for (const knowledge k : {signed_depth, eight_bits, exact}) {
        const summit once = climb(sight_dimensions, 100'000, 1, [&](const std::vector<double>& place) {
            const sight s = sight_at(place);
            const channels c = Format::decode(Format::encode(Format::from_moments(moments4_of(s.seen))));
            return double(within(Format{}, c, known(k, s.seen.depths), float(s.receiver))) - s.seen.below(s.receiver);
        });
        const summit passes = climb(contact_dimensions, 50'000, 2, [&](const std::vector<double>& place) {
            const contact s = contact_at(place);
            std::vector<float> depths;
            for (const auto& row : s.depths) depths.insert(depths.end(), row.begin(), row.end());
            const channels c = filtered_channels<Format>(s);
            return double(filtered_within(Format{}, c, known(k, depths), float(s.receiver))) - s.below(s.receiver);
        });
        std::printf("%s, knowledge %d: darkness %.3g, after two passes %.3g\n", std::string(Format::name).c_str(), k,
                    once.score, passes.score);
        CHECK(once.score <= stored4_arithmetic_weight);
        CHECK(passes.score <= stored4_arithmetic_weight);
    }
}

TEST_CASE("the more is known of the depths of a region, the less light leaks, by the stated amounts")
{
    const std::array<const char*, 4> rows = {"nothing", "depths are in [-1, 1]", "least and greatest, 8 bits",
                                             "least and greatest, exact"};
    std::array<std::array<double, 3>, 4> missing{};
    distribution_source source(5);
    constexpr int count = 300;
    for (int f = 0; f < family_count; ++f)
        for (int i = 0; i < count; ++i) {
            const distribution d = source.draw(family(f));
            const double on = d.depths[std::size_t(source.uniform(0, double(d.depths.size()) * 0.9999999))];
            const std::array<double, 3> receivers = {source.receiver(d), on, source.uniform(-1, 1)};
            const channels c =
                moments4_unorm16::decode(moments4_unorm16::encode(moments4_unorm16::from_moments(moments4_of(d))));
            for (std::size_t r = 0; r < 3; ++r) {
                const float z_f = float(receivers[r]);
                const double truth = d.below(double(z_f));
                const auto add = [&](std::size_t row, float shown) {
                    missing[row][r] += (truth - double(shown)) / (count * family_count);
                };
                add(0, moments4_unorm16::intensity(c, z_f));
                for (const knowledge k : {signed_depth, eight_bits, exact})
                    add(1 + std::size_t(k), within(moments4_unorm16{}, c, known(k, d.depths), z_f));
            }
        }
    for (std::size_t row = 0; row < rows.size(); ++row) {
        std::printf("| %s | %.2e | %.2e | %.2e |\n", rows[row], missing[row][0], missing[row][1], missing[row][2]);
        const std::vector<double> stated = documented("docs/decisions/2-bias.md", rows[row]);
        CHECK(stated.size() == 3);
        for (std::size_t r = 0; r < stated.size(); ++r)
            CHECK(stated[r] == doctest::Approx(missing[row][r]).epsilon(0.02));
        for (std::size_t r = 0; r < 3 && row > 0; ++r) CHECK(missing[row][r] < missing[row - 1][r]);
    }
}

// Dither makes the errors of storage independent, so that a filter in float averages them. No bound holds then. Noise
// of a quarter of a code, half of that of one rounding, suffices for all but few receivers. The rows state the gain.
TEST_CASE("dither on store and filtering in float leak less, by the stated amounts")
{
    constexpr int count = 4000;
    bit_source bits(11);
    double plain = 0, dithered = 0, darkest = -1;
    const auto shown = [](const channels& c, double noise, float z_f) {
        return double(moments4_theta_intensity(c, float(noise), float(certified4_unorm16_weight), z_f));
    };
    for (int i = 0; i < count; ++i) {
        std::vector<double> place(contact_dimensions);
        for (double& x : place) x = bits.uniform(0, 1);
        const contact s = contact_at(place);
        const auto filtered = [&](double amplitude) {
            moments4<float> sum{};
            for (std::size_t j = 0; j < 9; ++j)
                for (std::size_t k = 0; k < 9; ++k) {
                    channels c = moments4_unorm16::from_depth(s.depths[j][k]);
                    for (float* channel : {&c.c1, &c.c2, &c.c3, &c.c4})
                        *channel += float(bits.uniform(-amplitude, amplitude));
                    const channels stored = moments4_unorm16::decode(moments4_unorm16::encode(c));
                    sum = moments4_add(sum, moments4_from_channels(stored), s.taps[j] * s.taps[k]);
                }
            return channels4_from_moments(sum);
        };
        const float z_f = float(s.receiver);
        distribution seen;
        for (std::size_t j = 0; j < 9; ++j)
            for (std::size_t k = 0; k < 9; ++k) {
                seen.depths.push_back(double(s.depths[j][k]));
                seen.weights.push_back(double(s.taps[j]) * double(s.taps[k]));
            }
        const double ideal = ideal_lower<4>(seen, s.receiver), quarter_code = shown(filtered(1 / 131070.0), 4e-6, z_f);
        plain += std::max(0.0, ideal - shown(filtered(0), certified4_unorm16_noise, z_f)) / count;
        dithered += std::max(0.0, ideal - quarter_code) / count;
        darkest = std::max(darkest, quarter_code - s.below(s.receiver));
    }
    std::printf("| store | leak |\n| rounded | %.2e |\n| dithered | %.2e |\ndarkness %.1e\n", plain, dithered, darkest);
    const std::vector<double> rounded = documented("docs/decisions/2-bias.md", "rounded");
    const std::vector<double> with_dither = documented("docs/decisions/2-bias.md", "dithered");
    CHECK(rounded.size() == 1);
    CHECK(with_dither.size() == 1);
    if (rounded.size() == 1) CHECK(rounded[0] == doctest::Approx(plain).epsilon(0.02));
    if (with_dither.size() == 1) CHECK(with_dither[0] == doctest::Approx(dithered).epsilon(0.02));
    CHECK(dithered < plain);
}
