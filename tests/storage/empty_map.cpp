// Maps without casters, for every storage format: a map that was cleared shadows nothing, wherever the receiver is; a border
// texel darkens no lit surface, mixed with the map's own. The table of docs/conventions.md has the clear values.
#include "support/depth_situations.hpp"
#include "support/documented.hpp"
#include "support/effort.hpp"
#include "support/formats.hpp"

#include <gnomon/passes/look_up.hpp>
#include <gnomon/storage/formats.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string>
#include <tuple>

using namespace gnomon;
using namespace gnomon::test;

namespace {

/// A bilinear mixture of four texels in double.
template <class Format>
format_channels<Format, double> mixture(const std::array<format_texel<Format>, 4>& texels, bit_source& bits)
{
    const double x = bits.uniform(0, 1), y = bits.uniform(0, 1);
    const std::array weights{(1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y};
    std::array<double, channel_count<Format>> sum{};
    for (std::size_t i = 0; i < 4; ++i) {
        const auto channels = load_channels<Format>(texels[i]);
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += weights[i] * double(channels[k]);
    }
    return std::bit_cast<format_channels<Format, double>>(sum);
}

} // namespace

TEST_CASE("a cleared map shadows no receiver")
{
    for_each_format([]<storage_format Format>() {
        CAPTURE(Format::id);
        const auto cleared = Format::decode(Format::clear());
        const auto check = [&](float z_f) {
            REQUIRE(larger_intensity<Format>(cleared, z_f) <= larger_darkening<Format>());
            REQUIRE(larger_intensity<Format>(Format::border(), z_f) <= larger_darkening<Format>());
        };
        for (const float z_f : hostile_depths) check(z_f);
        hostile_source<float> source(4);
        for (std::int64_t i = 0; i < effort(20'000); ++i) check(source.pattern());
    });
}

TEST_CASE("a border texel darkens no lit surface, mixed with the map's own")
{
    for_each_format([]<storage_format Format>() {
        CAPTURE(Format::id);
        bit_source bits(5);
        for (std::int64_t i = 0; i < effort(4'000); ++i) {
            const float z = float(bits.uniform(-1, 1)), other = float(bits.uniform(double(z), 1));
            std::array<format_texel<Format>, 4> texels{
                Format::encode(Format::from_depth(z)), Format::encode(Format::from_depth(other)), Format::clear(),
                bits.chance(0.5) ? Format::clear() : Format::encode(Format::from_depth(z))};
            const map_view<const format_texel<Format>> map(texels, 2, 2);
            const auto c = bilinear<Format>(map, float(bits.uniform(0, 2)), float(bits.uniform(0, 2)));
            // Interpolation in float rounds once more, so one rounding has a mixture in double.
            const auto exact = mixture<Format>(texels, bits);
            const float in_front = z - (bits.chance(0.5) ? 0 : float(std::exp2(bits.uniform(-20, 0))));
            REQUIRE(Format::intensity(exact, double(in_front)) <= double(Format::darkening));
            REQUIRE(double(Format::filtered_intensity(c, in_front)) <= double(Format::filtered_darkening));
        }
    });
}

TEST_CASE("the documented clear values are those of the formats")
{
    for_each_format([]<storage_format Format>() {
        CAPTURE(Format::id);
        const auto channels = std::bit_cast<channel_array<Format>>(Format::border());
        std::string key = "`";
        key.append(Format::id) += '`';
        const std::vector<double> stated = documented("docs/conventions.md", key);
        // Of 32 channels the first eight are stated.
        REQUIRE(stated.size() == std::min<std::size_t>(channels.size(), 8));
        for (std::size_t k = 0; k < stated.size(); ++k)
            CHECK(stated[k] == doctest::Approx(double(channels[k])).epsilon(1e-5));
    });
}
