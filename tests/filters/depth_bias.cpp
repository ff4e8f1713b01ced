// Depth biases: finite and at least 0 for any arguments, with their stated errors, and as large as the claim that a plane
// never shadows itself needs.
#include "support/effort.hpp"
#include "support/hostile.hpp"
#include "support/rounding.hpp"

#include <gnomon/filters/depth_bias.h>
#include <gnomon/filters/percentage_closer.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace gnomon;
using namespace gnomon::test;

namespace {

using exact = long double;

/// Magnitudes over many orders, of either sign.
template <class T> T any_size(bit_source& bits)
{
    return T((bits.chance(0.5) ? 1 : -1) * std::exp2(bits.uniform(-20, 4)));
}

} // namespace

TEST_CASE_TEMPLATE("any arguments give a bias in [0, 2], a NaN gives 0", T, float, double)
{
    hostile_source<T> source(1);
    for (std::int64_t i = 0; i < effort(200'000); ++i) {
        const auto x = source.draw();
        const T slope = depth_bias_slope_scaled(x[0], x[1], x[2], x[3]);
        const T plane = depth_bias_receiver_plane(depth_gradient<T>{x[0], x[1]}, x[2], x[3], x[4]);
        for (const T bias : {slope, plane}) {
            REQUIRE(bias >= 0);
            REQUIRE(bias <= 2);
        }
        if (std::isnan(x[0]) || std::isnan(x[1]) || std::isnan(x[2])) {
            REQUIRE(slope == 0);
            REQUIRE(plane == 0);
        }
    }
}

TEST_CASE_TEMPLATE("biases have at most their stated errors", T, float, double)
{
    bit_source bits(2);
    double slope_error = 0, plane_error = 0, gradient_error = 0;
    for (std::int64_t i = 0; i < effort(200'000); ++i) {
        const T across = any_size<T>(bits), along = any_size<T>(bits), rise = std::abs(any_size<T>(bits));
        const T steepest = T(5.67);
        const auto relative = [](T value, exact want) { return std::abs(double(exact(value) / want - 1)) / u<T>; };
        const exact slope = std::min(std::abs(exact(across) / exact(along)), exact(steepest)) * exact(rise);
        if (slope <= 2)
            slope_error =
                std::max(slope_error, relative(depth_bias_slope_scaled(across, along, rise, steepest), slope));
        const depth_gradient<T> g{any_size<T>(bits), any_size<T>(bits)};
        const T half_x = T(bits.uniform(0, 40)), half_y = T(bits.uniform(0, 40));
        const exact plane = std::abs(exact(g.x) * exact(half_x)) + std::abs(exact(g.y) * exact(half_y));
        if (plane <= 2)
            plane_error = std::max(plane_error, relative(depth_bias_receiver_plane(g, half_x, half_y, T(2)), plane));
    }
    // Derivatives near parallel, whose determinants cancel. In float alone, where long double holds products exactly.
    for (std::int64_t i = 0; i < effort(200'000); ++i) {
        const float x1 = any_size<float>(bits), y1 = any_size<float>(bits), z1 = any_size<float>(bits);
        const double turn = std::exp2(bits.uniform(-20, 0));
        const float x2 = float(double(x1) * (1 + turn * bits.uniform(-1, 1))),
                    y2 = float(double(y1) * (1 + turn * bits.uniform(-1, 1)));
        const float z2 = float(double(z1) * (1 + turn * bits.uniform(-1, 1)));
        const auto minor = [](float a, float b, float c, float d) { return exact(a) * exact(b) - exact(c) * exact(d); };
        const exact determinant = minor(x1, y2, x2, y1);
        const exact want_x = minor(z1, y2, z2, y1) / determinant, want_y = minor(x1, z2, x2, z1) / determinant;
        if (determinant == 0 || want_x == 0 || want_y == 0) continue;
        const depth_gradient<float> g = depth_gradient_from_derivatives(x1, y1, z1, x2, y2, z2);
        gradient_error = std::max({gradient_error, std::abs(double(exact(g.x) / want_x - 1)) / u<float>,
                                   std::abs(double(exact(g.y) / want_y - 1)) / u<float>});
    }
    for (const auto& [error, stated] : {std::pair{slope_error, 2.0}, {plane_error, 2.0}, {gradient_error, 10.0}}) {
        CHECK(error <= stated * 1.001); // products of two roundings
        CHECK(error > 0.5);             // the measure sees errors
    }
}

TEST_CASE("a plane never shadows itself within the half widths of the filter, and does beyond")
{
    bit_source bits(3);
    int shadowed = 0;
    for (std::int64_t i = 0; i < effort(2'000); ++i) {
        // The plane z + g.x dx + g.y dy, seen through the screen: two directions of the map.
        const double z = bits.uniform(-0.2, 0.2), gx = bits.uniform(-0.01, 0.01), gy = bits.uniform(-0.01, 0.01);
        const double x1 = bits.uniform(0.5, 2), y1 = bits.uniform(-1, 1), x2 = bits.uniform(-1, 1),
                     y2 = bits.uniform(1.2, 2);
        const auto gradient = depth_gradient_from_derivatives(x1, y1, gx * x1 + gy * y1, x2, y2, gx * x2 + gy * y2);
        const double half_x = bits.uniform(0, 6), half_y = bits.uniform(0, 6);
        const double plane = depth_bias_receiver_plane(gradient, half_x, half_y, 2.0);
        // The normal of that plane, a unit of length being a texel, in a light that looks along z.
        const double rise = std::hypot(half_x, half_y);
        const double slope = depth_bias_slope_scaled(std::hypot(gx, gy), 1.0, rise, 5.67);
        const auto intensity = [&](double reach, double bias) {
            auto state = percentage_closer_begin(z - bias);
            for (int a = -8; a <= 8; ++a)
                for (int b = -8; b <= 8; ++b)
                    state =
                        percentage_closer_add(state, z + (gx * half_x * a + gy * half_y * b) * reach / 8, 1.0 / 289);
            return percentage_closer_end(state);
        };
        CHECK(intensity(1, plane + 1e-15) == 0);
        CHECK(intensity(1, slope + 1e-15) == 0);
        shadowed += intensity(1.5, plane) > 0;
    }
    CHECK(double(shadowed) > 0.9 * double(effort(2'000)));
}
