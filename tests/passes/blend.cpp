// Blending of translucent fragments into maps, for every storage format: the bits of an emulation of hardware, channels near
// those of the stack in double, an order that counts only within a texel, and the answers to bad opacities and shapes.
#include "support/effort.hpp"
#include "support/formats.hpp"
#include "support/stacks.hpp"

#include <gnomon/passes/blend.hpp>

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

constexpr std::size_t width = 5, height = 3, stride = 7;

/// A map of opaque surfaces, and fragments for it back to front.
template <class Format> struct blended_map {
    std::vector<format_texel<Format>> texels{stride * height, Format::clear()};
    std::vector<translucent_fragment> fragments;

    map_view<format_texel<Format>> view() { return {texels, width, height, stride}; }

    explicit blended_map(bit_source& bits)
    {
        for (std::uint32_t y = 0; y < height; ++y)
            for (std::uint32_t x = 0; x < width; ++x) {
                const stack s = any_stack(bits);
                view()(x, y) = texel_of_depth<Format>(float(s.behind));
                for (std::size_t k = 0; k < s.size(); ++k)
                    fragments.push_back({x, y, float(s.depths[k]), float(s.alphas[k])});
            }
    }
};

/// A texel after fragments of depths and opacities, by the text of a blending unit: source alpha, one minus source alpha.
template <class Format> format_texel<Format> by_hardware(format_texel<Format> texel, const translucent_fragment& f)
{
    const auto source = gnomon_bit_cast<channel_array<Format>>(Format::from_depth(f.depth));
    auto c = load_channels<Format>(texel);
    for (std::size_t k = 0; k < c.size(); ++k) {
        const float kept = (1 - f.alpha) * c[k];
        const float added = f.alpha * source[k];
        c[k] = kept + added;
    }
    return store_channels<Format>(c);
}

} // namespace

TEST_CASE("a blend has the bits of hardware that blends in float, for every format")
{
    for_each_format([]<storage_format Format>() {
        CAPTURE(Format::id);
        bit_source bits(1);
        for (std::int64_t i = 0; i < effort(300); ++i) {
            blended_map<Format> m(bits);
            auto expected = m.texels;
            for (const translucent_fragment& f : m.fragments)
                expected[f.y * stride + f.x] = by_hardware<Format>(expected[f.y * stride + f.x], f);
            blend<Format>(m.view(), m.fragments);
            REQUIRE(m.texels == expected); // texels between the rows are untouched, too
        }
    });
}

TEST_CASE("the order of fragments counts only within a texel")
{
    using format = moments4_unorm16;
    bit_source bits(2);
    for (std::int64_t i = 0; i < effort(2'000); ++i) {
        blended_map<format> m(bits);
        auto by_texel = m.texels;
        blend<format>({by_texel, width, height, stride}, m.fragments);
        // The same fragments, each drawn from a texel at random.
        std::array<std::vector<translucent_fragment>, width * height> stacks;
        for (const translucent_fragment& f : m.fragments) stacks[f.y * width + f.x].push_back(f);
        std::array<std::size_t, width * height> next{};
        std::vector<translucent_fragment> mixed;
        while (mixed.size() < m.fragments.size()) {
            const std::size_t t = bits.below(stacks.size());
            if (next[t] < stacks[t].size()) mixed.push_back(stacks[t][next[t]++]);
        }
        blend<format>(m.view(), mixed);
        REQUIRE(m.texels == by_texel);
    }
}

TEST_CASE("blended channels are off by the roundings that blends leave, at most")
{
    const auto check = []<class Format>(double once, double each) {
        CAPTURE(Format::id);
        bit_source bits(3);
        for (std::int64_t i = 0; i < effort(5'000); ++i) {
            stack s = any_stack(bits, 60);
            double least = 1;
            for (double& alpha : s.alphas) {
                alpha = double(float(alpha));
                if (alpha > 0) least = std::min(least, alpha);
            }
            std::array<format_texel<Format>, 1> texel{texel_of_depth<Format>(float(s.behind))};
            std::array<double, channel_count<Format>> exact{};
            const auto sum = [&](float depth, double keep, double alpha) {
                const auto c = gnomon_bit_cast<channel_array<Format>>(Format::from_depth(depth));
                for (std::size_t k = 0; k < exact.size(); ++k) exact[k] = keep * exact[k] + alpha * double(c[k]);
            };
            sum(float(s.behind), 0, 1);
            for (std::size_t k = 0; k < s.size(); ++k) {
                const translucent_fragment f{0, 0, float(s.depths[k]), float(s.alphas[k])};
                blend<Format>({texel, 1, 1}, std::span(&f, 1));
                sum(f.depth, 1 - s.alphas[k], s.alphas[k]);
            }
            const double allowed = once + each * double(blend_roundings_of_layers(float(least), float(s.size())));
            const auto c = load_channels<Format>(texel[0]);
            for (std::size_t k = 0; k < c.size(); ++k) REQUIRE(std::abs(double(c[k]) - exact[k]) <= allowed);
        }
    };
    check.operator()<variance_unorm16>(certified4_unorm16_noise, certified4_unorm16_noise);
    check.operator()<moments4_unorm16>(certified4_unorm16_noise, certified4_unorm16_noise);
    check.operator()<moments4_half>(certified4_half_noise, certified4_half_noise);
    check.operator()<moments4_float>(certified4_float_noise, blended_float_roundings * certified4_float_noise);
    check.operator()<moments6_unorm10>(0.5 / 1023, 0.5 / 1023 + 2e-7);
    check.operator()<moments6_unorm16>(certified4_unorm16_noise, certified4_unorm16_noise);
    check.operator()<moments6_float>(certified4_float_noise, blended_float_roundings * certified4_float_noise);
}

TEST_CASE("no fragment by an opacity of NaN, of 0 or less, or below that of the alpha test")
{
    for_each_format([]<storage_format Format>() {
        CAPTURE(Format::id);
        std::array<format_texel<Format>, 1> texel{texel_of_depth<Format>(0.5f)};
        const format_texel<Format> before = texel[0];
        const map_view<format_texel<Format>> map(texel, 1, 1);
        const float nan = std::numeric_limits<float>::quiet_NaN(), least = float(alpha_test_one_percent);
        const auto blend_one = [&](float depth, float alpha, float least_alpha = 0) {
            const translucent_fragment f{0, 0, depth, alpha};
            blend<Format>(map, std::span(&f, 1), least_alpha);
            const format_texel<Format> after = texel[0];
            texel[0] = before;
            return after;
        };
        for (const float none : {0.0f, -0.0f, -1.0f, -HUGE_VALF, nan}) CHECK(blend_one(-0.5f, none) == before);
        CHECK(blend_one(-0.5f, std::nextafter(least, 0.0f), least) == before);
        CHECK(blend_one(-0.5f, std::nextafter(least, 0.0f)) == blend_one(-0.5f, std::nextafter(least, 0.0f), nan));
        CHECK(blend_one(-0.5f, least, least) == blend_one(-0.5f, least));
        CHECK(blend_one(-0.5f, 0.5f, least) != before);
        for (const float all : {1.0f, 2.0f, HUGE_VALF}) CHECK(blend_one(-0.5f, all) == texel_of_depth<Format>(-0.5f));
        // A depth of NaN is no information: the far plane.
        CHECK(blend_one(nan, 0.5f) == blend_one(1, 0.5f));
        CHECK(blend_one(-7, 0.5f) == blend_one(-1, 0.5f));
    });
}

TEST_CASE("a fragment outside the map is refused, and nothing is written")
{
    using format = moments4_unorm16;
    std::vector<format::texel> texels(width * height, format::clear());
    const auto before = texels;
    const map_view<format::texel> map(texels, width, height);
    const auto refused = [&](std::uint32_t x, std::uint32_t y, const char* message) {
        const std::array<translucent_fragment, 2> fragments{{{0, 0, 0, 0.5f}, {x, y, 0, 0.5f}}};
        CHECK_THROWS_WITH_AS(blend<format>(map, fragments), message, std::invalid_argument);
        CHECK(texels == before);
    };
    refused(5, 0, "gnomon: blend: fragment.x is 5, but target.width is 5");
    refused(0, 3, "gnomon: blend: fragment.y is 3, but target.height is 3");
    CHECK_THROWS_WITH_AS(blend<format>({texels, 0, 3}, {}), "gnomon: blend: target.width is 0, but target.height is 3",
                         std::invalid_argument);
    CHECK_THROWS_AS(blend<format>({texels, 5, 4}, {}), std::invalid_argument);
    blend<format>(map, {});
    CHECK(texels == before);
}

TEST_CASE_TEMPLATE("absorbance is added in any order, and refuses what blend refuses", Format, absorbance4_half,
                   absorbance4_float)
{
    bit_source bits(5);
    const double rounding = std::is_same_v<Format, absorbance4_half> ? 0x1p-11 : 0x1p-24;
    for (std::int64_t i = 0; i < effort(2'000); ++i) {
        std::vector<format_texel<Format>> texels(width * height, Format::clear());
        std::vector<translucent_fragment> fragments;
        std::array<double, 5> exact{}, size{};
        for (std::size_t n = bits.below(20); n > 0; --n) {
            fragments.push_back({2, 1, float(bits.uniform(-1, 1)), float(std::exp2(bits.uniform(-8, 0)))});
            const auto c = gnomon_bit_cast<channel_array<Format>>(
                Format::from_fragment(fragments.back().depth, fragments.back().alpha));
            for (std::size_t k = 0; k < 5; ++k) exact[k] += double(c[k]), size[k] += std::abs(double(c[k]));
        }
        for (std::size_t k = fragments.size(); k > 1; --k) std::swap(fragments[k - 1], fragments[bits.below(k)]);
        accumulate<Format>({texels, width, height}, fragments);
        for (std::size_t t = 0; t < texels.size(); ++t) {
            const auto c = load_channels<Format>(texels[t]);
            for (std::size_t k = 0; k < 5; ++k) {
                const double allowed = double(fragments.size()) * (rounding * size[k] + 0x1p-25);
                REQUIRE(std::abs(double(c[k]) - (t == width + 2 ? exact[k] : 0)) <= allowed);
            }
        }
    }
    std::array<format_texel<Format>, 1> texel{Format::clear()};
    const map_view<format_texel<Format>> map(texel, 1, 1);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const float none : {0.0f, -1.0f, nan, 0.005f}) {
        const translucent_fragment f{0, 0, 0, none};
        accumulate<Format>(map, std::span(&f, 1), float(alpha_test_one_percent));
        CHECK(texel[0] == Format::clear());
    }
    const translucent_fragment outside{0, 1, 0, 0.5f};
    CHECK_THROWS_WITH_AS(accumulate<Format>(map, std::span(&outside, 1)),
                         "gnomon: accumulate: fragment.y is 1, but target.height is 1", std::invalid_argument);
    CHECK(texel[0] == Format::clear());
}
