// Overestimation of visibility on slices of random scenes, and of a tower before the light (Peters et al. 2017, Fig. 14), by
// four moments of 16 bits and six of 10 bits: errors of both adaptive forms and of a constant 1/2.
#include "support/effort.hpp"
#include "support/hostile.hpp"

#include <gnomon/moments/bounds.h>
#include <gnomon/moments/hamburger4.h>
#include <gnomon/moments/hamburger6.h>
#include <gnomon/scattering/rectified.h>
#include <gnomon/scattering/single_scattering.h>
#include <gnomon/storage/moments4.h>
#include <gnomon/storage/moments6.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

constexpr double pi = 3.14159265358979324;

/// The mean of the channels of depths, rounded to so many bits.
template <std::size_t count, class Encode>
std::array<float, count> mean_channels(const std::vector<float>& depths, int bits, Encode encode)
{
    std::array<double, count> sum{};
    for (const float z : depths) {
        const auto c = gnomon_bit_cast<std::array<float, count>>(encode(z));
        for (std::size_t k = 0; k < count; ++k) sum[k] += double(c[k]);
    }
    const double codes = std::exp2(bits) - 1;
    std::array<float, count> r{};
    for (std::size_t k = 0; k < count; ++k)
        r[k] = float(std::nearbyint(sum[k] / double(depths.size()) * codes) / codes);
    return r;
}

hamburger_bounds<float> four_moments(const std::vector<float>& depths, float z_f)
{
    const auto c = mean_channels<4>(depths, 16, [](float z) { return moments4_unorm16_encode(z); });
    return hamburger4_bounds(hankel4_from_unorm16(gnomon_bit_cast<channels4<float>>(c)), z_f);
}

hamburger_bounds<float> six_moments(const std::vector<float>& depths, float z_f)
{
    const auto c = mean_channels<6>(depths, 10, [](float z) { return moments6_unorm10_encode(z); });
    return hamburger6_bounds(hankel6_from_unorm10(gnomon_bit_cast<channels6<float>>(c)), z_f);
}

/// Visibility by adaptive_overestimation, by plateau_overestimation and by 1/2.
std::array<double, 3> visibilities(const hamburger_bounds<float>& bounds, double cosine)
{
    const float c = float(cosine);
    const std::array<float, 3> shares{adaptive_overestimation(c), plateau_overestimation(c), 0.5f};
    std::array<double, 3> r{};
    for (std::size_t k = 0; k < 3; ++k) r[k] = 1 - double(bounds_intensity(bounds, shares[k]));
    return r;
}

/// What stands on the ground of a slice.
enum class kind { houses, trees, roof };

/// A slice: a ground, and boxes on and over it. Light comes along z, the eye is at the origin.
struct slice {
    static constexpr int columns = 200;
    double ground;
    std::vector<std::array<double, 4>> boxes; // from r to r, from z to z

    slice(kind what, bit_source& bits) : ground(bits.uniform(0.05, 0.6))
    {
        const auto box = [&](double r, double width, double z, double height) {
            boxes.push_back({r, r + width, z, std::min(ground, z + height)});
        };
        if (what == kind::houses)
            for (std::size_t n = 1 + bits.below(7); n > 0; --n)
                box(bits.uniform(0.05, 1), bits.uniform(0.01, 0.25), ground - bits.uniform(0.05, 1.2),
                    bits.chance(0.6) ? 2 : bits.uniform(0.02, 0.2));
        if (what == kind::trees)
            for (int n = 0; n < 25; ++n)
                box(bits.uniform(0.02, 1), bits.uniform(0.002, 0.03), ground - bits.uniform(0.1, 1),
                    bits.uniform(0.002, 0.03));
        if (what == kind::roof) { // with slits, and a wall behind
            const double roof = -bits.uniform(0.1, 0.6);
            for (double r = 0; r < 1; r += bits.uniform(0.01, 0.1)) {
                const double width = bits.uniform(0.05, 0.3);
                box(r, width, roof, 0.02);
                r += width;
            }
            box(0.9, 0.1, roof, 2);
        }
    }
    [[nodiscard]] bool is_solid(double r, double z) const
    {
        return z >= ground || std::any_of(boxes.begin(), boxes.end(), [&](const auto& b) {
                   return b[0] <= r && r <= b[1] && b[2] <= z && z <= b[3];
               });
    }
    /// Polar angles of the first surfaces that light meets.
    [[nodiscard]] std::vector<double> occluders() const
    {
        std::vector<double> polar;
        for (int u = 0; u < columns; ++u) {
            const double r = (u + 0.5) / columns;
            double z = ground;
            for (const auto& b : boxes)
                if (b[0] <= r && r <= b[1]) z = std::min(z, b[2]);
            polar.push_back(std::atan2(r, z));
        }
        return polar;
    }
    /// The columns that a ray of this polar angle crosses before it meets a surface.
    [[nodiscard]] int reach(double polar) const
    {
        int u = 0;
        while (u < columns && !is_solid((u + 0.5) / columns, (u + 0.5) / columns / std::tan(polar))) ++u;
        return u;
    }
};

} // namespace

TEST_CASE("on slices of scenes the plateau has the least error, 1/2 the largest; under a roof all are alike")
{
    const auto error_of = [](kind what, auto bounds_of) {
        bit_source bits(1);
        std::array<double, 3> squares{};
        int rays = 0;
        for (std::int64_t i = 0; i < std::max<std::int64_t>(effort(2'000), 500); ++i) {
            const slice s(what, bits);
            if (s.is_solid(0, 0)) continue;
            const auto polar = s.occluders();
            const double least = bits.uniform(0, 2), most = std::min(pi, least + bits.uniform(0.5, 1.7));
            const auto range = rectified_polar_range(float(least), float(most));
            for (int k = 0; k < 10; ++k) {
                const double angle = bits.uniform(least, most);
                const int reach = s.reach(angle);
                std::vector<float> depths;
                double lit = 0;
                const float z_f = rectified_polar_depth(float(angle), range);
                for (int u = 0; u < reach; ++u) {
                    depths.push_back(rectified_polar_depth(float(polar[std::size_t(u)]), range));
                    lit += depths.back() >= z_f;
                }
                if (reach == 0) continue;
                const auto v = visibilities(bounds_of(depths, z_f), std::cos(angle));
                for (std::size_t m = 0; m < 3; ++m) squares[m] += (v[m] - lit / reach) * (v[m] - lit / reach);
                ++rays;
            }
        }
        for (double& x : squares) x = std::sqrt(x / rays);
        return squares;
    };
    for (const kind what : {kind::houses, kind::trees, kind::roof})
        for (const auto bounds_of : {&four_moments, &six_moments}) {
            const auto [adaptive, plateau, middle] = error_of(what, bounds_of);
            std::printf("| slice %d | %s moments | adaptive %.4f | plateau %.4f | middle %.4f |\n", int(what),
                        bounds_of == &four_moments ? "four" : "six", adaptive, plateau, middle);
            if (what == kind::roof) {
                CHECK((plateau < 1.1 * adaptive && middle < 1.2 * adaptive && middle > adaptive));
                continue;
            }
            CHECK(plateau < 0.95 * adaptive);
            CHECK(adaptive < 0.9 * middle);
        }
}

TEST_CASE("a tower before the light lets less than 1% leak within 5 degrees by both forms, where 1/2 lets 4% and more")
{
    for (const auto bounds_of : {&four_moments, &six_moments})
        for (const double top : {1.05, 1.2, 2.0}) // where the tower ends towards the light, of the distance of its wall
            for (const double degrees : {1.0, 2.0, 5.0, 10.0}) {
                const double angle = degrees * pi / 180, wall = std::tan(angle);
                const auto range = rectified_polar_range(float(pi - 1), float(pi));
                std::vector<float> depths;
                for (int u = 0; u < 200; ++u)
                    depths.push_back(rectified_polar_depth(float(std::atan2((u + 0.5) / 200 * wall, -top)), range));
                const float z_f = rectified_polar_depth(float(pi - angle), range);
                REQUIRE(*std::max_element(depths.begin(), depths.end()) < z_f); // all of the ray is in shadow
                const auto v = visibilities(bounds_of(depths, z_f), std::cos(pi - angle));
                CHECK(v[0] <= (degrees <= 5 ? 0.003 : 0.004));
                CHECK(v[1] <= (degrees <= 5 ? 0.01 : 0.02));
                if (top == 1.05) CHECK(v[2] > 0.04);
            }
}
