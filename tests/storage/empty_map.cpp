// Depths outside [-1, 1], for every storage format: a map that was cleared shadows nothing, wherever the receiver is; a
// border texel darkens no lit surface, mixed with the map's own; casters in front of the near plane shadow, casters and
// receivers beyond a plane are as on it. The table of docs/conventions.md has the clear values.
#include "support/documented.hpp"
#include "support/effort.hpp"
#include "support/hostile.hpp"

#include <gnomon/filters/percentage_closer.h>
#include <gnomon/passes/look_up.hpp>
#include <gnomon/storage/formats.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>

using namespace gnomon;
using namespace gnomon::test;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity(), nan_value = std::numeric_limits<float>::quiet_NaN();

/// Depths that nobody should store or ask for, and some ordinary ones.
constexpr std::array hostile_depths{-infinity, -1e30f,     -2.0f, -1.0000001f, -1.0f,    -0.99f,
                                    -0.5f,     -1e-40f,    0.0f,  1e-40f,      0.3f,     0.99f,
                                    1.0f,      1.0000001f, 2.0f,  1e30f,       infinity, nan_value};

template <class Format> double lit(format_channels<Format> c, float z_f)
{
    return std::max(double(Format::intensity(c, z_f)), double(Format::filtered_intensity(c, z_f)));
}

template <class Format> double most_darkening()
{
    return std::max(double(Format::darkening), double(Format::filtered_darkening));
}

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

/// Calls each.template operator()<Format>() for every storage format.
template <class Each> void for_each_format(Each each)
{
    [&]<class... Format>(std::tuple<Format...>*) {
        (each.template operator()<Format>(), ...);
    }(static_cast<storage_formats*>(nullptr));
}

} // namespace

TEST_CASE("a cleared map shadows no receiver")
{
    for_each_format([]<storage_format Format>() {
        CAPTURE(Format::id);
        const auto cleared = Format::decode(Format::clear());
        const auto check = [&](float z_f) {
            REQUIRE(lit<Format>(cleared, z_f) <= most_darkening<Format>());
            REQUIRE(lit<Format>(Format::border(), z_f) <= most_darkening<Format>());
        };
        for (const float z_f : hostile_depths) check(z_f);
        hostile_source<float> source(4);
        for (std::int64_t i = 0; i < effort(20'000); ++i) check(source.pattern());
        CHECK(lit<Format>(cleared, nan_value) == 0);
    });
}

TEST_CASE("casters and receivers anywhere are as on the plane they are beyond")
{
    for_each_format([]<storage_format Format>() {
        CAPTURE(Format::id);
        for (const float caster : hostile_depths) {
            const auto c = Format::decode(Format::encode(Format::from_depth(caster)));
            const auto closer = [&](float z_f) {
                const float one = 1;
                return percentage_closer_end(percentage_closer_add(percentage_closer_begin(z_f), caster, one));
            };
            for (const float receiver : hostile_depths) {
                CAPTURE(caster);
                CAPTURE(receiver);
                const float z = std::isnan(caster) ? 1 : std::clamp(caster, -1.0f, 1.0f);
                const float z_f = std::clamp(receiver, -1.0f, 1.0f);
                const double intensity = double(Format::intensity(c, receiver));
                CHECK(intensity == double(Format::intensity(c, z_f)));
                CHECK(double(Format::filtered_intensity(c, receiver)) == double(Format::filtered_intensity(c, z_f)));
                if (!(z < z_f)) CHECK(lit<Format>(c, receiver) <= most_darkening<Format>());
                if (z_f - z >= 0.25f) CHECK(intensity >= 0.94);
                // Filtering by percentage is what all estimate; it alone sees a caster before a receiver on the near plane.
                if (z_f > -1) CHECK(closer(receiver) == (z < z_f ? 1 : 0));
            }
        }
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
