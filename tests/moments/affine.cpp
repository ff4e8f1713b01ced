// Moments under a change of the depth range: those of the changed depths, with the stated error, and honest bounds for a
// mixture of two cascades' maps.
#include "support/climber.hpp"
#include "support/moments_of.hpp"
#include "support/rounding.hpp"

#include <gnomon/moments/affine.h>
#include <gnomon/moments/depth.h>
#include <gnomon/moments/hamburger4.h>
#include <gnomon/storage/formats.hpp>

#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <cmath>

using namespace gnomon;
using namespace gnomon::test;

namespace {

using exact = long double;

/// Two depths with weights, their moments in T, and the largest error of the changed moments in units of 2^-p.
template <class T, class Moments, std::size_t count>
double change_error(const std::vector<double>& x, Moments (*moments_affine)(Moments, depth_change<T>))
{
    const T scale = T(x[0] * 2 - 1), offset = T((1 - std::abs(double(scale))) * (x[1] * 2 - 1));
    const std::array<double, 3> depths{x[2] * 2 - 1, x[3] * 2 - 1, x[4] * 2 - 1};
    const std::array<double, 3> weights{x[5] * x[6], x[5] * (1 - x[6]), 1 - x[5]};
    std::array<exact, count> before{}, after{};
    for (std::size_t i = 0; i < 3; ++i) {
        exact power = 1;
        for (std::size_t j = 0; j < count; ++j) before[j] += exact(weights[i]) * (power *= exact(depths[i]));
    }
    std::array<T, count> b{};
    for (std::size_t j = 0; j < count; ++j) b[j] = T(before[j]);
    // The exact change of the rounded moments: the binomial sum.
    for (std::size_t j = 1; j <= count; ++j) {
        exact binomial = 1;
        for (std::size_t k = 0; k <= j; ++k) {
            const exact moment = k == 0 ? exact(1) : exact(b[k - 1]);
            after[j - 1] +=
                binomial * std::pow(exact(scale), exact(k)) * std::pow(exact(offset), exact(j - k)) * moment;
            binomial = binomial * exact(j - k) / exact(k + 1);
        }
    }
    const auto r = std::bit_cast<std::array<T, count>>(moments_affine(std::bit_cast<Moments>(b), {scale, offset}));
    double error = 0;
    for (std::size_t j = 0; j < count; ++j) error = std::max(error, std::abs(double(exact(r[j]) - after[j])) / u<T>);
    return error;
}

} // namespace

TEST_CASE_TEMPLATE("a change of range has at most its stated error, by climbing", T, float, double)
{
    const auto four = climb(7, 300'000, 1, [](const auto& x) {
        return change_error<T, moments4<T>, 4>(x, [](auto b, auto change) { return moments4_affine(b, change); });
    });
    const auto six = climb(7, 300'000, 2, [](const auto& x) {
        return change_error<T, moments6<T>, 6>(x, [](auto b, auto change) { return moments6_affine(b, change); });
    });
    MESSAGE("four ", four.score, ", six ", six.score);
    CHECK(four.score <= 6);
    CHECK(six.score <= 9);
    CHECK(four.score > 1);
    CHECK(six.score > 1);
}

TEST_CASE("a change of range is that of the depths, and of moments of depth in [0, 1] the known one")
{
    bit_source bits(3);
    for (std::int64_t i = 0; i < effort(20'000); ++i) {
        const double near_distance = bits.uniform(0.1, 5), far_distance = near_distance + bits.uniform(1, 50);
        const double target_near = near_distance - bits.uniform(0, 3), target_far = far_distance + bits.uniform(0, 30);
        const auto change = depth_change_from_planes(near_distance, far_distance, target_near, target_far);
        const double at = bits.uniform(near_distance, far_distance);
        const double z = depth_from_distance(at, near_distance, far_distance);
        const double want = depth_from_distance(at, target_near, target_far);
        REQUIRE(std::abs(depth_affine(z, change) - want) <= 1e-13);
        REQUIRE(std::abs(change.scale) + std::abs(change.offset) <= 1 + 1e-13); // a range that contains the other
        const auto by_moments = moments4_affine(moments4_from_depth(z), change);
        const auto by_depth = moments4_from_depth(want);
        REQUIRE(std::abs(by_moments.b4 - by_depth.b4) <= 1e-12);
        const double unit = bits.uniform(0, 1);
        const auto one = moments4_from_unit(moments4_from_depth(unit));
        const auto two = moments4_affine(moments4_from_depth(unit), depth_change<double>{2, -1});
        for (const double d : {one.b1 - two.b1, one.b2 - two.b2, one.b3 - two.b3, one.b4 - two.b4})
            REQUIRE(std::abs(d) <= 1e-14);
    }
}

TEST_CASE_TEMPLATE("a change between planes has at most its stated error", T, float, double)
{
    bit_source bits(5);
    double error = 0;
    for (std::int64_t i = 0; i < effort(200'000); ++i) {
        const auto plane = [&](double from, double extent) { return T(from + extent * bits.uniform(0.01, 1)); };
        const T near_distance = plane(0, 50), far_distance = plane(double(near_distance), 100);
        const T target_near = plane(0, 50), target_far = plane(double(target_near), 100);
        const depth_change<T> change = depth_change_from_planes(near_distance, far_distance, target_near, target_far);
        const exact extent = exact(target_far) - exact(target_near);
        const exact scale = (exact(far_distance) - exact(near_distance)) / extent;
        const exact offset =
            ((exact(near_distance) - exact(target_near)) + (exact(far_distance) - exact(target_far))) / extent;
        const double unit = u<T> * double(std::max(exact(far_distance), exact(target_far)) / extent);
        error = std::max({error, std::abs(double(exact(change.scale) - scale)) / unit,
                          std::abs(double(exact(change.offset) - offset)) / unit});
    }
    CHECK(error <= 8); // two for the differences, and for their sum, extent and quotient two each
    CHECK(error > 1);
}

TEST_CASE("a mixture of two cascades darkens no lit surface by more than the stated weight, by climbing")
{
    // Each map holds two depths in 4 x 16 UNORM; the finer one is changed to the range of the coarser one.
    using format = moments4_unorm16;
    const auto darkening = [](const std::vector<double>& x) {
        const double near_distance = x[0] * 4, far_distance = near_distance + 0.5 + 4 * x[1];
        const double target_near = near_distance - 2 * x[2], target_far = far_distance + 4 * x[3];
        const auto change = depth_change_from_planes(near_distance, far_distance, target_near, target_far);
        const auto place = [&](double t) { return near_distance + t * (far_distance - near_distance); };
        const std::array<double, 3> distances{place(x[4]), place(x[4] + (x[5] - x[4]) * 1e-2), place(x[6])};
        const std::array<double, 3> weights{x[7] * x[8], x[7] * (1 - x[8]), 1 - x[7]};
        const double mixed = x[9];
        std::array<double, 4> fine{}, coarse{};
        for (std::size_t i = 0; i < 3; ++i) {
            const auto f = moments4_from_depth(depth_from_distance(distances[i], near_distance, far_distance));
            const auto c = moments4_from_depth(depth_from_distance(distances[i], target_near, target_far));
            const auto add = [&](std::array<double, 4>& sum, const moments4<double>& b) {
                sum[0] += weights[i] * b.b1, sum[1] += weights[i] * b.b2;
                sum[2] += weights[i] * b.b3, sum[3] += weights[i] * b.b4;
            };
            add(fine, f), add(coarse, c);
        }
        const auto stored = [](const std::array<double, 4>& b) {
            const moments4<float> m{float(b[0]), float(b[1]), float(b[2]), float(b[3])};
            return theta4_inverse(format::decode(format::encode(theta4(m))));
        };
        const moments4<float> f =
            moments4_affine(stored(fine), depth_change<float>{float(change.scale), float(change.offset)});
        const moments4<float> b = moments4_add(moments4_scale(f, float(1 - mixed)), stored(coarse), float(mixed));
        const double at = distances[std::size_t(x[10] * 2.999)] + (x[11] - 0.5) * 1e-4 * (far_distance - near_distance);
        double truth = 0;
        for (std::size_t i = 0; i < 3; ++i) truth += distances[i] < at ? weights[i] : 0;
        const float z_f = float(depth_from_distance(at, target_near, target_far));
        const float weight = float(affine4_unorm16_weight);
        const hankel4<float> h =
            hankel4_from_moments(moments4_add_bias(b, float(bias4_raw_b2), float(bias4_raw_b4), weight));
        return double(hamburger4_lower(h, z_f)) - truth;
    };
    const auto found = climb(12, 300'000, 4, darkening);
    MESSAGE("darkened by ", found.score);
    CHECK(found.score <= affine4_unorm16_weight + 1e-6);
}
