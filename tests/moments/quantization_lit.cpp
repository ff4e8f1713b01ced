// No acne: in every storage format a receiver on or in front of a single surface stays lit, up to the stated darkening.
// Surfaces are constant and tilted planes, seen by single texels and by regions after two filter passes that round to
// the format again.
#include "support/effort.hpp"
#include "support/hostile.hpp"
#include "support/moments_of.hpp"

#include <gnomon/storage/formats.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

using namespace gnomon;
using namespace gnomon::test;

namespace {

/// The nine taps of a Gaussian, normalised in float.
std::array<float, 9> gaussian()
{
    std::array<float, 9> taps{};
    float sum = 0;
    for (int i = 0; i < 9; ++i) sum += taps[std::size_t(i)] = float(std::exp(-(i - 4) * (i - 4) / 8.0));
    for (float& w : taps) w /= sum;
    return taps;
}

template <class Format> typename Format::texel surface(float z) { return Format::encode(Format::from_depth(z)); }

/// The texel that one pass makes of nine.
template <class Format> typename Format::texel filtered_line(const std::array<typename Format::texel, 9>& row)
{
    static const std::array<float, 9> taps = gaussian();
    return Format::encode(weighted_sum<Format>(row, taps));
}

/// The texel of a plane z + i x + j y over 9x9 texels after both passes.
template <class Format> typename Format::texel filtered_plane(float z, float x, float y)
{
    std::array<typename Format::texel, 9> row, column;
    for (int j = -4; j <= 4; ++j) {
        for (int i = -4; i <= 4; ++i)
            row[std::size_t(i + 4)] = surface<Format>(std::clamp(z + float(i) * x + float(j) * y, -1.0f, 1.0f));
        column[std::size_t(j + 4)] = filtered_line<Format>(row);
    }
    return filtered_line<Format>(column);
}

struct acne {
    float worst = 0;
    std::string where;

    template <class Format> void add(typename Format::texel t, float nearest, bool after_passes, bit_source& bits)
    {
        const auto c = Format::decode(t);
        const float in_front = float(std::ldexp(bits.uniform(0.5, 1), -int(bits.below(30))));
        for (const float z_f : {nearest, std::max(nearest - in_front, -1.0f), -1.0f}) {
            const float intensity = after_passes ? Format::filtered_intensity(c, z_f) : Format::intensity(c, z_f);
            if (intensity > worst)
                worst = intensity, where = "surface " + std::to_string(nearest) + ", receiver " + std::to_string(z_f);
        }
    }
};

} // namespace

TEST_CASE_TEMPLATE("a receiver on or before a single surface is lit in every format", Format, moments4_unorm16,
                   moments4_half, moments4_float, moments6_unorm10, moments6_unorm16, moments6_float)
{
    bit_source bits(7);
    acne single, constant, tilted;
    // Denser where the formats darken most: at the ends and near z^2 = 1/2.
    const auto depth = [&] {
        if (bits.chance(0.2)) return (bits.chance(0.5) ? 1.0f : -1.0f) * float(bits.uniform(0.705, 0.709));
        return bits.chance(0.05) ? (bits.chance(0.5) ? -1.0f : 1.0f) : float(bits.uniform(-1, 1));
    };
    for (std::int64_t i = 0; i < effort(1'000'000); ++i) {
        const float z = depth();
        single.add<Format>(surface<Format>(z), z, false, bits);
    }
    for (std::int64_t i = 0; i < effort(30'000); ++i) {
        const float z = depth();
        constant.add<Format>(filtered_plane<Format>(z, 0, 0), z, true, bits);
        const auto slope = [&] { return float(bits.uniform(-1, 1) * std::pow(10.0, -bits.uniform(1.5, 6))); };
        const float x = slope(), y = slope();
        const float nearest = std::max(z - 4 * std::abs(x) - 4 * std::abs(y), -1.0f);
        tilted.add<Format>(filtered_plane<Format>(z, x, y), nearest, true, bits);
    }
    const float allowed = float(Format::darkening), after_passes = float(Format::filtered_darkening);
    std::printf("%-12s single %.2g of %.2g, constant 9x9 %.2g, tilted 9x9 %.2g of %.2g\n",
                std::string(Format::name).c_str(), double(single.worst), double(allowed), double(constant.worst),
                double(tilted.worst), double(after_passes));
    CHECK_MESSAGE(single.worst <= allowed, single.where);
    CHECK_MESSAGE(constant.worst <= after_passes, constant.where);
    CHECK_MESSAGE(tilted.worst <= after_passes, tilted.where);
}
