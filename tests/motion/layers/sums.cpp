// Visibility through a layer: never below that of the samples themselves, for two moments, four and an exponential; full
// opacity behind all samples; no weight, no opacity, hostile sums; without motion the plain filter's shadow.
#include "layer_cases.hpp"
#include "support/climber.hpp"
#include "support/effort.hpp"

#include <gnomon/storage/layer_formats.hpp>

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <cstdint>

using namespace gnomon;
using namespace gnomon::test;

namespace {

template <class T> constexpr exponential_settings<T> warp{T(40)};

/// Samples in the layer at their own depths, and counts of those behind it and before it.
template <class T> struct texel_content {
    std::vector<T> depths;
    int behind = 0, before = 0;
};

template <class T, class Sums> Sums sums_of(const texel_content<T>& content, auto add)
{
    Sums sums{};
    for (const T z : content.depths) sums = add(sums, z, layer_share_of(T(1), T(1)));
    for (int k = 0; k < content.behind; ++k) sums = add(sums, T(0.3), layer_share_of(T(2), T(1)));
    for (int k = 0; k < content.before; ++k) sums = add(sums, T(-0.3), layer_share_of(T(0), T(1)));
    return sums;
}

template <class T> layer_sums<T> variance_of(const texel_content<T>& c)
{
    return sums_of<T, layer_sums<T>>(c, [](auto... x) { return layer_sums_add(x...); });
}

template <class T> layer_moments4_sums<T> moments_of(const texel_content<T>& c)
{
    return sums_of<T, layer_moments4_sums<T>>(c, [](auto... x) { return layer_moments4_add(x...); });
}

template <class T> layer_exponential_sums<T> exponential_of(const texel_content<T>& c)
{
    return sums_of<T, layer_exponential_sums<T>>(c, [](auto... x) { return layer_exponential_add(x..., warp<T>); });
}

/// The visibility of a receiver through the samples of a texel.
template <class T> wide exact_visibility(const texel_content<T>& c, T z)
{
    const auto hit = std::count_if(c.depths.begin(), c.depths.end(), [&](T a) { return a < z; });
    return 1 - wide(hit) / wide(int(c.depths.size()) + c.behind);
}

/// Up to eight samples in the layer, and some behind and before it, by numbers in [0, 1].
template <class T> texel_content<T> content_at(const std::vector<double>& p)
{
    texel_content<T> c;
    const double width = std::exp2(-16 * p[1]);
    for (std::size_t k = 4; k < p.size(); ++k)
        c.depths.push_back(T(std::clamp((2 * p[0] - 1) + width * (2 * p[k] - 1), -1., 1.)));
    c.behind = int(std::exp2(8 * p[2])) - 1;
    c.before = int(4 * p[3]);
    return c;
}

/// Distance by which the visibility by each kind of sums is below that of the samples, in units of the stated error.
template <class T> std::array<double, 3> darkening(const texel_content<T>& c, T z, T least)
{
    const wide exact = exact_visibility(c, z), samples = wide(c.depths.size());
    const layer_sums<T> two = variance_of(c);
    const wide mean = wide(two.z) / wide(two.opacity), square = wide(two.zz) / wide(two.opacity);
    const wide variance = std::max<wide>(square - mean * mean, wide(least)), d = wide(z) - mean;
    const wide q = (square + wide(z) * wide(z)) / (variance + d * d), unit = wide(u<T>);
    const wide four = wide(layer_moments4_visibility(moments_of(c), z, T(samples + 1)));
    return {
        double((exact - wide(layer_visibility(two, z, least))) /
               (unit * ((samples + 4) * (1 + 4 * q + std::sqrt(q)) + 2))),
        double((exact - four) / (is_float<T> ? 1e-6L : 1e-9L)),
        double((exact - wide(layer_exponential_visibility(exponential_of(c), z, warp<T>))) / (unit * (47 + samples)))};
}

} // namespace

TEST_CASE_TEMPLATE("layer visibility: never darker than the samples but for the stated error", T, float, double)
{
    for (const std::size_t samples : {1u, 2u, 3u, 8u})
        for (const std::size_t kind : {0u, 1u, 2u}) {
            const auto score = [&](const std::vector<double>& p) {
                const texel_content<T> c = content_at<T>({p.begin() + 3, p.end()});
                // A receiver at, before or behind one of the samples.
                const T z = T(double(c.depths[0]) + (p[0] - 0.5) * std::exp2(-24 * p[1]));
                return darkening(c, z, T(p[2] < 0.5 ? 0 : std::exp2(-40 * p[2])))[kind];
            };
            const summit worst = climb(7 + samples, 50'000, 51 + samples, score);
            CHECK_MESSAGE(worst.score <= 1, samples << " samples, kind " << kind << ": " << worst.score);
            CHECK((draws_few() || worst.score > 0));
        }
}

TEST_CASE("layer visibility: formats are not darker than texels of thousands of samples at a few depths")
{
    bit_source bits(58);
    const auto check = [&]<class Format>(Format, double constant, double of_each) {
        for (int n = 16; n <= 16384; n *= 4)
            for (std::int64_t i = 0; i < effort(200); ++i) {
                std::array<std::pair<float, int>, 3> depths; // equal samples are rounded alike
                const double centre = bits.uniform(-1, 1), width = std::exp2(bits.uniform(-16, 0));
                for (auto& [z, count] : depths)
                    z = float(std::clamp(centre + width * bits.uniform(-1, 1), -1., 1.)), count = 0;
                format_channels<Format> sums{};
                for (int k = 0; k < n; ++k) {
                    auto& [z, count] = depths[bits.below(1 + std::size_t(i % 3))];
                    sums = Format::add(sums, z, {1, 1}), ++count;
                }
                for (const auto& at : depths) {
                    const float z = at.first + float(bits.uniform(-1, 1) * std::exp2(bits.uniform(-24, -10)));
                    double lit = 1;
                    for (const auto& [depth, count] : depths) lit -= depth < z ? double(count) / n : 0;
                    const double v = double(Format::visibility(sums, z, float(Format::least_variance)));
                    REQUIRE(v >= lit - constant - of_each * n);
                }
            }
    };
    check(layer_moments4_float{}, 1e-6, 0);
    check(layer_exponential_float{}, double(u<float>) * (layer_exponential_float::exponent + 7), double(u<float>));
}

TEST_CASE_TEMPLATE("layer visibility: all of the opacity behind the layer, none of it in front", T, float, double)
{
    const auto property = [](std::uint64_t seed) {
        bit_source bits(seed);
        std::vector<double> place(4 + 1 + bits.below(8));
        for (double& x : place) x = bits.uniform(0, 1);
        const texel_content<T> c = content_at<T>(place);
        const T opacity = T(c.depths.size()) / T(int(c.depths.size()) + c.behind);
        const T behind = T(1 + std::exp2(bits.uniform(-20, 4))), before = T(-std::exp2(bits.uniform(0, 4)));
        const auto close = [](T a, T b) { return std::abs(a - b) <= 2 * T(u<T>); };
        RC_ASSERT(close(layer_visibility(variance_of(c), behind, T(0)), 1 - opacity));
        RC_ASSERT(close(layer_moments4_visibility(moments_of(c), behind, T(8)), 1 - opacity));
        RC_ASSERT(close(layer_exponential_visibility(exponential_of(c), behind, warp<T>), 1 - opacity));
        RC_ASSERT(layer_visibility(variance_of(c), before, T(0)) == 1);
        RC_ASSERT(layer_moments4_visibility(moments_of(c), before, T(8)) == 1);
        RC_ASSERT(layer_exponential_visibility(exponential_of(c), before, warp<T>) == 1);
    };
    CHECK(rc::check("any texel", property));
    for (std::int64_t i = 0; i < effort(20'000); ++i) property(std::uint64_t(i));
}

TEST_CASE_TEMPLATE("layer visibility: no weight is no information, a weight without opacity is transparent", T, float,
                   double)
{
    const texel_content<T> nothing, seen_past{{}, 5, 3}, before{{}, 0, 7};
    for (const texel_content<T>& c : {nothing, seen_past, before}) {
        CHECK(layer_visibility(variance_of(c), T(0.5), T(1e-6)) == 1);
        CHECK(layer_moments4_visibility(moments_of(c), T(0.5), T(8)) == 1);
        CHECK(layer_exponential_visibility(exponential_of(c), T(0.5), warp<T>) == 1);
        CHECK(layer_visibility(variance_of(c), T(2), T(1e-6)) == 1);
    }
    CHECK(variance_of(nothing).weight == 0);
    CHECK(variance_of(before).weight == 0);
    CHECK(variance_of(seen_past).weight == 5);
    // A sample of NaN is in front of every layer; the background is behind all of them.
    for (int layer = 0; layer < 4; ++layer) {
        CHECK(layer_share_of(T(-1), T(layer)).weight == 0);
        const layer_share<T> background = layer_share_of(T(4), T(layer));
        CHECK((background.weight == 1 && background.opacity == 0));
    }
    const T nan = std::numeric_limits<T>::quiet_NaN();
    CHECK(layer_share_of(nan, T(0)).weight == 0);
    CHECK(layer_sums_add(layer_sums<T>{}, nan, layer_share<T>{1, 1}).z == 1);
}

TEST_CASE_TEMPLATE("layer visibility: any sums and receivers give a visibility, NaN is lit", T, float, double)
{
    hostile_source<T> hostile(56);
    const T nan = std::numeric_limits<T>::quiet_NaN();
    for (std::int64_t i = 0; i < effort(500'000); ++i) {
        const auto x = hostile.draw();
        const T z = hostile.special(), setting = hostile.special();
        for (const T v :
             {layer_visibility(layer_sums<T>{x[0], x[1], x[2], x[3]}, z, setting),
              layer_moments4_visibility(layer_moments4_sums<T>{x[0], x[1], x[2], x[3], x[4], x[5]}, z, setting),
              layer_exponential_visibility(layer_exponential_sums<T>{x[0], x[1], x[2]}, z, {setting})})
            REQUIRE((v >= 0 && v <= 1));
        REQUIRE(layer_visibility(layer_sums<T>{x[0], x[1], x[2], x[3]}, nan, setting) == 1);
        REQUIRE(layer_visibility(layer_sums<T>{x[0], x[1], x[2], nan}, z, setting) == 1);
        REQUIRE(layer_visibility(layer_sums<T>{x[0], x[1], nan, x[3]}, z, setting) == 1);
    }
}

TEST_CASE_TEMPLATE("layer visibility: without motion, in one layer, the plain variance shadow of the same samples", T,
                   float, double)
{
    bit_source bits(57);
    for (std::int64_t i = 0; i < effort(20'000); ++i) {
        // A layer that spans all depths has them for its own.
        const layer_grid<T> grid = layer_grid_make(layer_motion<T>{0, 0, 0, 0, 0, -1, 1}, T(8), T(8));
        REQUIRE((grid.scale == 1 && grid.centre == 0));
        texel_content<T> c;
        variance_moments<T> plain{};
        const std::size_t n = std::size_t(1) << bits.below(5);
        for (std::size_t k = 0; k < n; ++k) {
            const T z = T(bits.uniform(-1, 1));
            c.depths.push_back(layer_grid_own_depth(grid, z, T(bits.uniform(0, 1))));
            const variance_moments<T> one = variance_encode(z);
            plain.mean += one.mean, plain.square += one.square;
        }
        plain.mean /= T(n), plain.square /= T(n);
        const T z_f = T(bits.uniform(-0.99, 0.99)), least = T(1e-5);
        REQUIRE(layer_visibility(variance_of(c), z_f, least) == 1 - variance_intensity(plain, z_f, {least}));
    }
}
