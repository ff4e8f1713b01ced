// Storage formats as types: every code survives decoding and encoding in every channel, a texel is as large as stated,
// and channels stand where the formats say.
#include "support/effort.hpp"
#include "support/hostile.hpp"

#include <gnomon/storage/formats.hpp>

#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <cmath>
#include <limits>

using namespace gnomon;
using namespace gnomon::test;

namespace {

template <class Format> constexpr std::uint32_t codes = std::is_same_v<Format, moments6_unorm10> ? 1024 : 65536;

/// A texel that holds the code in every channel, other codes beside it.
template <class Format> typename Format::texel texel_of(const std::array<std::uint32_t, channel_count<Format>>& code)
{
    typename Format::texel t{};
    for (std::size_t j = 0; j < code.size(); ++j) {
        if constexpr (std::is_same_v<Format, moments6_unorm10>) t[j / 3] |= code[j] << 10 * (j % 3);
        else t[j] = static_cast<std::uint16_t>(code[j]);
    }
    return t;
}

template <class Format> constexpr bool is_half = std::is_same_v<Format, moments4_half>;

} // namespace

TEST_CASE_TEMPLATE("every code round-trips in every channel", Format, moments4_unorm16, moments4_half, moments6_unorm10,
                   moments6_unorm16)
{
    constexpr std::size_t n = channel_count<Format>;
    bit_source bits(1);
    for (std::uint32_t code = 0; code < codes<Format>; ++code) {
        if (is_half<Format> && (code & 0x7fff) > 0x7c00) continue; // NaN stays one, but not which (passes_storage.cpp)
        for (std::size_t j = 0; j < n; ++j) {
            std::array<std::uint32_t, n> all;
            for (auto& c : all) c = std::uint32_t(bits.below(is_half<Format> ? 0x7c00 : codes<Format>));
            all[j] = code;
            const auto t = texel_of<Format>(all);
            const auto c = Format::decode(t);
            REQUIRE(Format::encode(c) == t);
            if (!is_half<Format>)
                REQUIRE(std::abs(double(std::bit_cast<channel_array<Format>>(c)[j]) -
                                 double(code) / (codes<Format> - 1)) <= 0x1p-24);
        }
    }
}

TEST_CASE_TEMPLATE("floats are stored as they are, but for NaN", Format, moments4_float, moments6_float)
{
    hostile_source<float> source(2);
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        const auto x = source.draw();
        typename Format::texel t;
        std::copy_n(x.begin(), t.size(), t.begin());
        const auto back = Format::encode(Format::decode(t));
        if (are_known(Format::decode(t))) REQUIRE(back == t);
        else REQUIRE(back == Format::clear());
    }
}

TEST_CASE_TEMPLATE("what a format states about itself", Format, moments4_unorm16, moments4_half, moments4_float,
                   moments6_unorm10, moments6_unorm16, moments6_float)
{
    CHECK(sizeof(typename Format::texel) == Format::bytes_per_texel);
    // The bias is a vector of moments: of depths in [-1, 1], and no degenerate ones.
    const auto& bias = Format::bias;
    CHECK(bias.size() == channel_count<Format> / 2);
    CHECK(bias[0] < 1);
    CHECK(bias[1] > bias[0] * bias[0]);
    CHECK(bias[1] <= bias[0]);
    if constexpr (channel_count<Format> == 6) {
        CHECK(bias[2] > bias[1] * bias[1] / bias[0]);
        CHECK(bias[2] <= bias[1]);
    }
    CHECK(Format::bias_weight > 0);
    CHECK(Format::bias_weight < 0.01);
}

TEST_CASE_TEMPLATE("numbers outside the range, and NaN, have a code", Format, moments4_unorm16, moments6_unorm10,
                   moments6_unorm16)
{
    const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    const auto filled = [](float x) {
        channel_array<Format> c;
        c.fill(x);
        return Format::encode(std::bit_cast<format_channels<Format>>(c));
    };
    CHECK(filled(-1) == filled(0));
    CHECK(filled(-infinity) == filled(0));
    CHECK(filled(nan) == Format::clear());
    CHECK(filled(2) == filled(1));
    CHECK(filled(infinity) == filled(1));
    CHECK(filled(0) == typename Format::texel{});
}
