// Smoke of many thin layers, and the tables of docs/translucency.md: errors by the bound that receivers take, among the layers
// and behind them; what roundings of blends do to the channels and to the shadow; layers that vanish.
#include "support/documented.hpp"
#include "support/stacks.hpp"

#include <gnomon/passes/blend.hpp>
#include <gnomon/storage/formats.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

constexpr auto page = "docs/translucency.md";
constexpr std::size_t layers = 30, texels = 9;
constexpr float least = float(alpha_test_one_percent);

/// Nine texels of a filter region in smoke between two depths, with opacities at random. Some have a pipe in the middle.
struct smoke {
    double near = 0, far = 0;
    std::array<stack, texels> seen; // fragments in front of opaque surfaces
    std::array<std::vector<translucent_fragment>, texels> all;

    smoke(bit_source& bits, double most, std::size_t pipes)
    {
        near = bits.uniform(-0.8, 0);
        far = near + bits.uniform(0.2, 0.6);
        for (std::size_t t = 0; t < texels; ++t) {
            seen[t].behind = t < pipes ? double(float((near + far) / 2)) : 1;
            for (std::size_t k = 0; k < layers; ++k) {
                const auto z = float(far - (far - near) * (double(k) + 0.5) / layers);
                const auto alpha = float(bits.uniform(double(least), most));
                all[t].push_back({0, 0, z, alpha});
                if (double(z) > seen[t].behind) continue;
                seen[t].depths.push_back(double(z));
                seen[t].alphas.push_back(double(alpha));
            }
        }
    }

    [[nodiscard]] double shadow(double z_f) const
    {
        double sum = 0;
        for (const stack& s : seen) sum += 1 - s.transmittance(z_f);
        return sum / texels;
    }
};

/// The mean channels of a region; fill writes each texel.
template <class Format, class Fill> format_channels<Format> mean_channels(Fill fill)
{
    channel_array<Format> sum{};
    for (std::size_t t = 0; t < texels; ++t) {
        std::array<format_texel<Format>, 1> texel{Format::clear()};
        fill(map_view<format_texel<Format>>(texel, 1, 1), t);
        const auto c = load_channels<Format>(texel[0]);
        for (std::size_t k = 0; k < c.size(); ++k) sum[k] += c[k] / float(texels);
    }
    return gnomon_bit_cast<format_channels<Format>>(sum);
}

template <class Format> format_texel<Format> texel_at(double z) { return Format::encode(Format::from_depth(float(z))); }

template <class Format> format_channels<Format> blended(const smoke& s)
{
    return mean_channels<Format>([&](auto map, std::size_t t) {
        map(0, 0) = texel_at<Format>(s.seen[t].behind);
        std::vector<translucent_fragment> visible;
        for (const auto& f : s.all[t])
            if (double(f.depth) <= s.seen[t].behind) visible.push_back(f);
        blend<Format>(map, visible);
    });
}

/// Intensities at z_f: variance, four moments by the lower bound and by the middle of both, six moments, absorbance.
constexpr std::size_t methods = 7;
std::array<double, methods> intensities(const smoke& s, float z_f)
{
    const float n = blend_roundings_of_layers(least, float(layers));
    const auto four = blended<moments4_unorm16>(s);
    const auto six = blended<moments6_unorm16>(s);
    const auto bounds4 = hamburger4_bounds(moments4_unorm16::blended_factor(four, n), z_f);
    const auto bounds6 = hamburger6_bounds(moments6_unorm16::blended_factor(six, n), z_f);
    const auto absorbed = mean_channels<absorbance4_float>(
        [&](auto map, std::size_t t) { accumulate<absorbance4_float>(map, s.all[t]); });
    const auto opaque = mean_channels<moments4_float>(
        [&](auto map, std::size_t t) { map(0, 0) = texel_at<moments4_float>(s.seen[t].behind); });
    const float pipe = moments4_float_filtered_intensity(opaque, z_f);
    const auto absorbance = [&](float overestimation) {
        return double(
            transmitted_intensity(pipe, absorbance4_float_transmittance(absorbed, float(layers), overestimation, z_f)));
    };
    return {double(variance_unorm16_intensity(blended<variance_unorm16>(s), z_f)),
            double(moments4_unorm16_blended_intensity(four, n, z_f)),
            double(bounds_intensity(bounds4, 0.5f)),
            double(bounds6.lower),
            double(bounds_intensity(bounds6, 0.5f)),
            absorbance(1),
            absorbance(0.5f)};
}

void check_row(const std::string& key, const std::vector<double>& measured, double tolerance)
{
    const std::vector<double> stated = documented(page, key);
    std::printf("| %s |", key.c_str());
    for (const double x : measured) std::printf(" %.3g |", x);
    std::printf("\n");
    CHECK(stated.size() == measured.size());
    if (stated.size() != measured.size()) return;
    for (std::size_t k = 0; k < stated.size(); ++k) CHECK(stated[k] == doctest::Approx(measured[k]).epsilon(tolerance));
}

} // namespace

// The choice of the bound that docs/translucency.md gives.
TEST_CASE("receivers among layers of smoke take the middle of the bounds, surfaces behind it the lower one")
{
    const auto errors = [](const std::string& key, double most, std::size_t pipes, bool inside) {
        bit_source bits(5);
        constexpr int count = 1000;
        std::array<double, methods> square{};
        for (int i = 0; i < count; ++i) {
            const smoke s(bits, most, pipes);
            const auto z_f = float(inside ? bits.uniform(s.near, s.far) : bits.uniform(s.far, 1));
            const double truth = s.shadow(double(z_f));
            const auto shown = intensities(s, z_f);
            for (std::size_t m = 0; m < methods; ++m) square[m] += (shown[m] - truth) * (shown[m] - truth) / count;
        }
        std::vector<double> rmse;
        for (const double x : square) rmse.push_back(std::sqrt(x));
        check_row(key, rmse, 0.02);
        return rmse;
    };
    for (const std::size_t pipes : {std::size_t(0), std::size_t(4)}) {
        const std::string with = pipes > 0 ? ", with a pipe" : "";
        for (const int percent : {5, 15}) {
            const std::string key = "smoke of up to " + std::to_string(percent) + "%" + with;
            const auto inside = errors("in " + key, percent / 100.0, pipes, true);
            errors("behind " + key, percent / 100.0, pipes, false);
            CHECK(inside[2] < 0.4 * inside[1]); // the middle
            CHECK(inside[4] < 0.4 * inside[3]);
            CHECK(inside[6] < 0.4 * inside[5]);
        }
    }
}

namespace {

/// How far channels are off in half codes, how much darker than the truth the intensity for one rounding and that for blends
/// are at most, and how much lighter blends make the latter than exact channels do.
template <class Format> std::vector<double> effect_of_roundings(std::size_t count, double alpha)
{
    constexpr int stacks = 200;
    const auto a = float(alpha);
    const float n = blend_roundings_of_layers(a, float(count));
    bit_source bits(7);
    double off = 0, once = 0, darker = 0, lighter = 0;
    for (int i = 0; i < stacks; ++i) {
        const double near = bits.uniform(-0.9, 0.5), far = near + bits.uniform(0.001, 0.4);
        stack s{double(float(bits.chance(0.5) ? 1 : bits.uniform(far, 1))), {}, {}};
        std::array<format_texel<Format>, 1> texel{texel_at<Format>(s.behind)};
        std::array<double, channel_count<Format>> exact{};
        const auto add = [&](float z, double weight) {
            const auto c = gnomon_bit_cast<channel_array<Format>>(Format::from_depth(z));
            for (std::size_t k = 0; k < exact.size(); ++k) exact[k] += weight * (double(c[k]) - exact[k]);
        };
        add(float(s.behind), 1);
        for (std::size_t k = 0; k < count; ++k) {
            const translucent_fragment f{0, 0, float(far - (far - near) * (double(k) + 0.5) / double(count)), a};
            blend<Format>({texel, 1, 1}, std::span(&f, 1));
            add(f.depth, double(a));
            s.depths.push_back(double(f.depth));
            s.alphas.push_back(double(a));
        }
        const auto stored = load_channels<Format>(texel[0]);
        channel_array<Format> ideal{};
        for (std::size_t k = 0; k < exact.size(); ++k) {
            ideal[k] = float(exact[k]);
            off = std::max(off, std::abs(double(stored[k]) - exact[k]) * 131070);
        }
        const auto c = Format::decode(texel[0]), e = gnomon_bit_cast<format_channels<Format>>(ideal);
        for (const double z : {s.behind, 0.7 * far + 0.3 * s.behind, (near + far) / 2, 0.8 * near + 0.2 * far}) {
            const auto z_f = float(z);
            const double truth = 1 - s.transmittance(double(z_f));
            const double shown = double(Format::blended_intensity(c, n, z_f));
            const double gain = double(Format::blended_intensity(e, n, z_f)) - shown;
            once = std::max(once, double(Format::intensity(c, z_f)) - truth);
            darker = std::max(darker, shown - truth);
            lighter = std::max(lighter, gain);
        }
    }
    CHECK(off <= double(n) * 2 * 65535 * certified4_unorm16_noise + 1);
    CHECK(darker <= stored4_arithmetic_weight);
    return {off, double(n), once, lighter};
}

} // namespace

TEST_CASE("roundings of blends darken intensities for one rounding, and lighten those for blends a little")
{
    check_row("200 layers of 10%", effect_of_roundings<moments4_unorm16>(200, 0.1), 0.05);
    check_row("100 layers of 1%", effect_of_roundings<moments4_unorm16>(100, 0.01), 0.05);
    check_row("1000 layers of 1%", effect_of_roundings<moments4_unorm16>(1000, 0.01), 0.05);
    check_row("1000 layers of 0.1%", effect_of_roundings<moments4_unorm16>(1000, 0.001), 0.05);
}

TEST_CASE("layers near the surface behind vanish from texels of 16 bits, but neither from floats nor from absorbance")
{
    // alpha times the difference of any channel is less than half a code.
    const double behind = 0.5;
    const std::vector<translucent_fragment> faint(1000, {0, 0, float(behind - 1e-4), 0.01f});
    const auto blend_into = [&]<class Format>() {
        std::array<format_texel<Format>, 1> texel{texel_at<Format>(behind)};
        blend<Format>({texel, 1, 1}, faint);
        return texel[0];
    };
    const double truth = 1 - std::pow(1 - double(0.01f), 1000);
    CHECK(truth > 0.9999);
    CHECK(blend_into.operator()<moments4_unorm16>() == texel_at<moments4_unorm16>(behind));
    CHECK(blend_into.operator()<moments6_unorm16>() == texel_at<moments6_unorm16>(behind));
    const auto floats = moments4_float::decode(blend_into.operator()<moments4_float>());
    CHECK(double(moments4_float_blended_intensity(floats, blend_roundings(0.01f), 0.75f)) > 0.98);
    CHECK(double(floats.c1) == doctest::Approx(behind - 1e-4 * truth).epsilon(1e-5));
    std::array<absorbance4_half::texel, 1> texel{absorbance4_half::clear()};
    accumulate<absorbance4_half>({texel, 1, 1}, faint);
    const float left = absorbance4_half::transmittance(absorbance4_half::decode(texel[0]), 10.0f, 1.0f, 0.75f);
    CHECK(double(left) < 0.001);
}
