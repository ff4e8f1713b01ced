// Distance behind a surface that fills the filter region, from which on a receiver shows 90% of the shadow, for each
// format: the table of docs/stability.md. Storage makes close depths indistinguishable, and bounds that darken no lit
// surface leave a receiver lit that is too close behind its occluder.
#include "support/documented.hpp"

#include <gnomon/passes/blur.hpp>
#include <gnomon/storage/formats.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

using namespace gnomon;

namespace {

constexpr double shrink = 0.98; // a step of the scan

/// The least distance behind a surface at z from which on shown(z_f) is at least 0.9, up to a step.
template <class Shown> double gap(float z, Shown shown)
{
    double least = 1;
    for (double distance = 1; distance > 1e-6; distance *= shrink) {
        const float z_f = float(double(z) + distance);
        if (z_f > 1) continue;
        if (double(shown(z_f)) < 0.9) break;
        least = distance;
    }
    return least;
}

struct gaps {
    double mean, largest; // the geometric mean
};

/// The gaps of surfaces from the near plane to 0.6, stored once or after two passes.
template <class Format> gaps gaps_of(bool filtered)
{
    double logarithms = 0, largest = 0;
    constexpr int count = 400;
    for (int i = 0; i < count; ++i) {
        const float z = float(-1 + 1.6 * (i + 0.37) / count);
        std::vector<format_texel<Format>> map(81, Format::encode(Format::from_depth(z))), scratch(map);
        if (filtered) blur<Format>({map, 9, 9}, {scratch, 9, 9}, {map, 9, 9}, gaussian_weights());
        const auto c = Format::decode(map[40]);
        const double found = gap(
            z, [&](float z_f) { return filtered ? Format::filtered_intensity(c, z_f) : Format::intensity(c, z_f); });
        logarithms += std::log(found);
        largest = std::max(largest, found);
    }
    return {std::exp(logarithms / count), largest};
}

} // namespace

TEST_CASE_TEMPLATE("a receiver shows its shadow from the stated distance behind the occluder on", Format,
                   moments4_unorm16, moments4_half, moments4_float, moments6_unorm10, moments6_unorm16, moments6_float)
{
    const gaps once = gaps_of<Format>(false), passes = gaps_of<Format>(true);
    const std::array found = {once.mean, once.largest, passes.mean, passes.largest};
    const std::string key = '`' + std::string(Format::id) + '`';
    std::printf("| %s |", key.c_str());
    for (const double x : found) std::printf(" %.2g |", x);
    std::printf("\n");
    const std::vector<double> stated = gnomon::test::documented("docs/stability.md", key);
    REQUIRE(stated.size() == found.size());
    for (std::size_t k = 0; k < found.size(); ++k) CHECK(stated[k] == doctest::Approx(found[k]).epsilon(0.06));
}

TEST_CASE("of formats of 64 bits UNORM resolves occluders best, then halves of the transformed moments")
{
    CHECK(gaps_of<moments4_unorm16>(false).mean < 0.3 * gaps_of<moments4_half>(false).mean);
    CHECK(gaps_of<moments4_half>(false).mean < 0.031);
}
