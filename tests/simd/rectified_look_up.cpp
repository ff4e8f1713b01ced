// Look-ups of view rays by packs have the bits of those one by one.
#include "support/effort.hpp"
#include "support/situations.hpp"

#include <gnomon/passes/transmittance_prefix.hpp>
#include <gnomon/simd/rectified_look_up.hpp>
#include <gnomon/simd/xsimd.hpp>
#include <gnomon/storage/formats.hpp>

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

using namespace gnomon;
using gnomon::test::bit_source;

namespace {

using real = gnomon::pack<xsimd::batch<float>>;
constexpr std::size_t lanes = sizeof(real) / sizeof(float);

std::uint32_t bits_of(float x) { return x == x ? std::bit_cast<std::uint32_t>(x) : 0x7fc00000u; }

/// A mip chain of random averages, with the frame and the rows of a random view.
template <class Format> struct random_map {
    std::size_t width, height;
    rectified_frame frame;
    std::vector<rectified_row> rows;
    std::vector<format_texel<Format>> texels;

    explicit random_map(bit_source& bits)
        : width(1 + bits.below(40)), height(1 + bits.below(40)), rows(height), texels(mip_texels(width, height))
    {
        const bool is_turn = bits.chance(0.3);
        frame = {float(bits.uniform(0.1, 9)), float(bits.uniform(-3, 3)),
                 is_turn ? 6.2831855f : float(bits.uniform(0.1, 6)),
                 bits.chance(0.5) ? rectified_depth::polar : rectified_depth::cosine};
        const bool are_alike = bits.chance(0.5);
        for (rectified_row& r : rows)
            r = are_alike && &r != rows.data()
                    ? rows[0]
                    : rectified_row{1,
                                    0,
                                    rectified_polar_range(0.2f, float(bits.uniform(0.3, 3))),
                                    1,
                                    float(bits.chance(0.2) ? 0 : std::exp2(bits.uniform(-12, 2))),
                                    float(bits.chance(0.6) ? 0 : bits.uniform(-0.1, 0.1))};
        for (auto& t : texels) t = Format::encode(Format::from_depth(float(bits.uniform(-1, 1))));
    }
    [[nodiscard]] mip_view<const format_texel<Format>> mips() const { return {texels, width, height}; }
};

} // namespace

TEST_CASE_TEMPLATE("look-ups by packs have the bits of those one by one", Format, moments4_unorm16, moments4_float,
                   moments6_unorm10, moments6_float, convolution_unorm8)
{
    bit_source bits(5501);
    for (std::int64_t round = 0; round < test::effort(2000); ++round) {
        const random_map<Format> map(bits);
        const bool is_hostile = bits.chance(0.2);
        const auto any = [&](double least, double most) {
            return float(is_hostile && bits.chance(0.2) ? double(test::any_number<float>(bits))
                                                        : bits.uniform(least, most));
        };
        alignas(real) std::array<float, lanes> radius, azimuth, polar, level;
        const float common = bits.chance(0.3) ? 0 : float(bits.uniform(0, 3));
        for (std::size_t i = 0; i < lanes; ++i) {
            radius[i] = any(0, 1.2 * double(map.frame.radius)), azimuth[i] = any(-3.2, 3.2), polar[i] = any(0, 3.2);
            level[i] = bits.chance(0.5) ? common : any(-1, 7);
        }
        const rectified_position<real> position{real::load_aligned(radius.data()), real::load_aligned(azimuth.data()),
                                                real::load_aligned(polar.data())};
        const auto together = gnomon_bit_cast<std::array<std::array<float, lanes>, channel_count<Format>>>(
            rectified_channels<Format>(map.mips(), map.frame, map.rows, position, real::load_aligned(level.data())));
        alignas(real) std::array<float, lanes> depths;
        rectified_depth_at(map.frame, map.rows, position).store_aligned(depths.data());
        for (std::size_t i = 0; i < lanes; ++i) {
            const rectified_position<float> one{radius[i], azimuth[i], polar[i]};
            const auto alone = gnomon_bit_cast<channel_array<Format>>(
                rectified_channels<Format>(map.mips(), map.frame, map.rows, one, level[i]));
            for (std::size_t k = 0; k < alone.size(); ++k) REQUIRE(bits_of(together[k][i]) == bits_of(alone[k]));
            REQUIRE(bits_of(depths[i]) == bits_of(rectified_depth_at(map.frame, map.rows, one)));
        }
    }
}

TEST_CASE("a map or rows without entries give the border")
{
    using format = moments4_float;
    const rectified_position<real> position{real(1.f), real(1.f), real(1.f)};
    const auto border = gnomon_bit_cast<channel_array<format>>(stored_border<format>());
    const auto found = gnomon_bit_cast<std::array<std::array<float, lanes>, 4>>(
        rectified_channels<format>(mip_view<const format::texel>{}, rectified_frame{}, {}, position, real(0.f)));
    for (std::size_t k = 0; k < 4; ++k)
        for (const float c : found[k]) CHECK(c == border[k]);
    alignas(real) std::array<float, lanes> depth;
    rectified_depth_at(rectified_frame{}, {}, position).store_aligned(depth.data());
    CHECK(depth[0] == -1);
}
