// Rows of texels, side by side or apart, have the bits of single texels: for every format, any numbers, every code, ties between codes, and rows of every
// length, beside which nothing is written.
#include "support/effort.hpp"
#include "support/formats.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

template <class Format> void check_row(const std::vector<float>& numbers)
{
    constexpr std::size_t channels = channel_count<Format>;
    const std::size_t count = numbers.size() / channels;
    std::vector<format_texel<Format>> texels(count + 1, Format::clear());
    store_row<Format>(numbers.data(), texels.data(), count);
    REQUIRE(same_bytes(texels[count], Format::clear()));
    std::vector<float> loaded(count * channels + 1, 7.0f);
    load_row<Format>(texels.data(), loaded.data(), count);
    REQUIRE(loaded.back() == 7);
    for (std::size_t i = 0; i < count; ++i) {
        channel_array<Format> c;
        std::copy_n(numbers.begin() + std::ptrdiff_t(i * channels), channels, c.begin());
        REQUIRE(same_bytes(texels[i], store_channels<Format>(c)));
        std::copy_n(loaded.begin() + std::ptrdiff_t(i * channels), channels, c.begin());
        REQUIRE(same_bytes(c, load_channels<Format>(texels[i])));
    }
    for (const std::size_t stride : {2u, 5u}) {
        std::vector<format_texel<Format>> apart(count * stride + 1, Format::clear());
        store_row<Format>(numbers.data(), apart.data(), count, stride);
        std::vector<float> again(count * channels + 1, 7.0f);
        load_row<Format>(apart.data(), again.data(), count, stride);
        REQUIRE(std::memcmp(again.data(), loaded.data(), again.size() * sizeof(float)) == 0);
        for (std::size_t i = 0; i < apart.size(); ++i)
            REQUIRE(same_bytes(apart[i], i % stride == 0 && i / stride < count ? texels[i / stride] : Format::clear()));
    }
}

} // namespace

TEST_CASE("rows of any numbers")
{
    for_each_format([]<storage_format Format>() {
        CAPTURE(Format::id);
        hostile_source<float> source(1);
        bit_source bits(1);
        for (std::int64_t i = 0; i < effort(3'000); ++i) {
            std::vector<float> numbers(bits.below(70) * channel_count<Format>);
            const bool any = bits.chance(0.5);
            for (float& x : numbers) x = any && bits.chance(0.1) ? source.draw()[0] : float(bits.uniform(-0.1, 1.1));
            check_row<Format>(numbers);
        }
    });
}

TEST_CASE_TEMPLATE("rows of every code, of ties between codes and the numbers beside these", Format, moments4_unorm16,
                   moments6_unorm10, moments6_unorm16, variance_unorm16, convolution_unorm8)
{
    const double most = std::is_same_v<Format, moments6_unorm10>     ? 1023
                        : std::is_same_v<Format, convolution_unorm8> ? 255
                                                                     : 65535;
    std::vector<float> numbers;
    for (double code = 0; code <= most; ++code)
        for (const double off : {0.0, 0.5}) {
            const float x = float((code + off) / most);
            for (const float y : {std::nextafter(x, 0.0f), x, std::nextafter(x, 2.0f)}) numbers.push_back(y);
        }
    check_row<Format>(numbers);
    numbers.insert(numbers.begin(), 0.5f); // each number in the next channel
    check_row<Format>(numbers);
}
