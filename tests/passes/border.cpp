// Border modes, for every storage format: look-ups and blurs by border_mode::lit are those of a map in a frame of clear
// texels, bit by bit, and have the bits of border_mode::clamp inside the map. A caster at the map's edge leaves no streak.
#include "support/effort.hpp"
#include "support/formats.hpp"

#include <gnomon/passes/blur.hpp>
#include <gnomon/passes/look_up.hpp>

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

/// A map of random depths, and the same map in a frame of clear texels.
template <class Format> struct framed_map {
    using texels = std::vector<format_texel<Format>>;
    std::size_t width, height, margin;
    texels inside, whole;

    framed_map(bit_source& bits, std::size_t m)
        : width(1 + bits.below(9)),
          height(1 + bits.below(9)),
          margin(m),
          inside(width * height),
          whole((width + 2 * m) * (height + 2 * m), Format::clear())
    {
        for (std::size_t k = 0; k < inside.size(); ++k) {
            inside[k] = texel_of_depth<Format>(float(bits.uniform(-1, 1)));
            whole[(k / width + m) * (width + 2 * m) + k % width + m] = inside[k];
        }
    }
    map_view<format_texel<Format>> map() { return {inside, width, height}; }
    map_view<format_texel<Format>> framed() { return {whole, width + 2 * margin, height + 2 * margin}; }
};

} // namespace

TEST_CASE("look-ups by lit are those of a framed map; inside a map they are those by clamp")
{
    for_each_format([]<storage_format Format>() {
        CAPTURE(Format::id);
        bit_source bits(1);
        for (std::int64_t i = 0; i < effort(2'000); ++i) {
            framed_map<Format> m(bits, 8);
            // Steps of 2^-8 keep sums and differences of positions exact.
            const auto place = [&](std::size_t extent) {
                return float(std::round(bits.uniform(-6, double(extent) + 6) * 256) / 256);
            };
            const float x = place(m.width), y = place(m.height);
            const auto lit = bilinear<Format>(m.map(), x, y, border_mode::lit);
            REQUIRE(same_bytes(lit, bilinear<Format>(m.framed(), x + 8, y + 8)));
            const bool inside = x >= 0.5f && y >= 0.5f && x <= float(m.width) - 0.5f && y <= float(m.height) - 0.5f;
            if (inside) REQUIRE(same_bytes(lit, bilinear<Format>(m.map(), x, y)));
            const bool beyond = x <= -0.5f || y <= -0.5f || x >= float(m.width) + 0.5f || y >= float(m.height) + 0.5f;
            if (beyond) REQUIRE(larger_intensity<Format>(lit, 1) <= larger_darkening<Format>());
        }
        framed_map<Format> m(bits, 1);
        for (const float far : {-1e30f, 1e30f, -std::numeric_limits<float>::infinity(), HUGE_VALF})
            for (const auto& c : {bilinear<Format>(m.map(), far, 0.5f, border_mode::lit),
                                  bilinear<Format>(m.map(), 0.5f, far, border_mode::lit)})
                CHECK(same_bytes(c, bilinear<Format>(m.framed(), 0.5f, 0.5f)));
    });
}

TEST_CASE("blurs by lit are those of a framed map")
{
    for_each_format([]<storage_format Format>() {
        CAPTURE(Format::id);
        bit_source bits(2);
        for (std::int64_t i = 0; i < effort(300); ++i) {
            const std::size_t radius = bits.below(5);
            framed_map<Format> m(bits, radius);
            std::vector<float> weights(2 * radius + 1);
            float sum = 0;
            for (float& w : weights) sum += w = float(bits.uniform(0, 1));
            for (float& w : weights) w /= sum;
            auto target = m.whole, result = m.inside;
            const map_view<format_texel<Format>> framed(target, m.framed().width, m.framed().height),
                alone(result, m.width, m.height);
            const auto compare = [&] {
                for (std::size_t y = 0; y < m.height; ++y)
                    for (std::size_t x = 0; x < m.width; ++x)
                        REQUIRE(same_bytes(alone(x, y), framed(x + radius, y + radius)));
            };
            blur_along_x<Format>(m.framed(), framed, weights, {0, framed.height});
            blur_along_x<Format>(m.map(), alone, weights, {0, m.height}, border_mode::lit);
            compare();
            blur_along_y<Format>(m.framed(), framed, weights, {0, framed.height});
            const std::size_t split = bits.below(m.height + 1);
            blur_along_y<Format>(m.map(), alone, weights, {split, m.height}, border_mode::lit);
            blur_along_y<Format>(m.map(), alone, weights, {0, split}, border_mode::lit);
            compare();
        }
    });
}

// A wall on the near plane fills the last columns. Behind it everything is dark, and beyond the edge too, by clamp.
TEST_CASE("a caster at the edge darkens nothing farther beyond than the filter reaches; receivers beyond either plane")
{
    for_each_format([]<storage_format Format>() {
        CAPTURE(Format::id);
        constexpr std::size_t side = 16, radius = 4;
        std::vector<format_texel<Format>> texels(mip_texels(side, side), Format::clear()), scratch(side * side);
        for (std::size_t y = 0; y < side; ++y)
            for (std::size_t x = side - 6; x < side; ++x) texels[y * side + x] = texel_of_depth<Format>(-1);
        const mip_view<format_texel<Format>> mips{texels, side, side};
        blur<Format>(mips.level(0), {scratch, side, side}, mips.level(0), gaussian_weights<2 * radius + 1>(),
                     border_mode::lit);
        build_mips<Format>(mips);
        for (const float z_f : {-HUGE_VALF, -1.0f, 0.5f, 1.0f, 3.0f, HUGE_VALF}) {
            CAPTURE(z_f);
            const auto shadow = [&](float x, float level, border_mode mode) {
                return double(Format::filtered_intensity(trilinear<Format>(mips, x, 8, level, mode), z_f));
            };
            const double most = larger_darkening<Format>();
            for (float beyond = 0; beyond < 40; beyond += 0.25f) {
                // A level's texels are larger: half of one reaches beyond the edge.
                for (const float level : {0.0f, 0.5f, 1.0f, 2.0f})
                    if (beyond >= 0.5f * std::exp2(std::ceil(level)))
                        CHECK(shadow(float(side) + beyond, level, border_mode::lit) <= most);
                if (z_f >= 1) CHECK(shadow(float(side) + beyond, 0, border_mode::clamp) >= 0.4);
                if (beyond >= 6.5f + radius) CHECK(shadow(float(side) - beyond, 0, border_mode::lit) <= most);
            }
            if (z_f >= 1) CHECK(shadow(float(side) - 1, 0, border_mode::lit) >= 0.5);
            if (z_f <= -1) CHECK(shadow(float(side) - 1, 0, border_mode::lit) <= most);
        }
    });
}
