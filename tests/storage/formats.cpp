// Storage formats of filters by bounds of few numbers: every code survives the round trip, a surface lights itself and
// shadows what lies behind it after the roundings that the format allows for.
#include <gnomon/passes/blur.hpp>
#include <gnomon/storage/formats.hpp>

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <random>
#include <vector>

using namespace gnomon;

#define EVERY_FORMAT                                                                          \
    variance_unorm16, layered_variance_unorm16, exponential_float, exponential_variance_half, \
        exponential_variance_float, convolution_unorm8

TEST_CASE_TEMPLATE("stored channels decode and encode to the same code", Format, EVERY_FORMAT)
{
    using texel = typename Format::texel;
    using code = typename texel::value_type;
    for (std::uint32_t i = 0; i < 65536; ++i) {
        texel t{};
        for (std::size_t k = 0; k < t.size(); ++k) t[k] = code(i % (std::uint32_t(1) << (sizeof(code) < 2 ? 8 : 16)));
        const bool half_nan = Format::name.ends_with("half") && (i & 0x7fff) > 0x7c00;
        if (!half_nan) REQUIRE(Format::encode(Format::decode(t)) == t);
    }
}

namespace {

/// The channels of a map that shows one depth everywhere, rendered and blurred: three roundings.
template <class Format> auto blurred_plane(float z)
{
    std::vector<typename Format::texel> map(15 * 15, Format::encode(Format::from_depth(z))), scratch(map);
    blur<Format>({map, 15, 15}, {scratch, 15, 15}, {map, 15, 15}, gaussian_weights());
    return Format::decode(map[7 * 15 + 7]);
}

} // namespace

TEST_CASE_TEMPLATE("a surface is lit, what lies in front too, what lies behind is not", Format, EVERY_FORMAT)
{
    std::mt19937 random(9);
    std::uniform_real_distribution<float> depth(-1, 1);
    for (int i = 0; i < 2000; ++i) {
        const float z = depth(random);
        const auto plane = blurred_plane<Format>(z);
        CHECK(double(Format::filtered_intensity(plane, z)) <= Format::filtered_darkening);
        const float front = -1 + (z + 1) * std::uniform_real_distribution<float>(0, 1)(random);
        CHECK(double(Format::filtered_intensity(plane, front)) <= Format::filtered_darkening);
        const float behind = z + 0.25f + (1 - z) * std::uniform_real_distribution<float>(0, 1)(random);
        if (behind <= 1) CHECK(double(Format::filtered_intensity(plane, behind)) >= 0.94);
    }
    const auto cleared = blurred_plane<Format>(1);
    CHECK(double(Format::filtered_intensity(cleared, -1.0f)) <= Format::filtered_darkening);
    CHECK(double(Format::filtered_intensity(cleared, 1.0f)) <= Format::filtered_darkening);
}

TEST_CASE_TEMPLATE("NaN in a map or at the receiver is lit", Format, EVERY_FORMAT)
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    channel_array<Format> channels;
    channels.fill(nan);
    const auto none = std::bit_cast<format_channels<Format>>(channels);
    CHECK(Format::intensity(none, 0.5f) == 0);
    CHECK(Format::intensity(Format::decode(Format::encode(Format::from_depth(-0.5f))), nan) == 0);
    const float from_nan = Format::intensity(Format::decode(Format::encode(Format::from_depth(nan))), 0.5f);
    CHECK(from_nan >= 0);
    CHECK(from_nan <= 1);
}

// Half of a filter region covered: half shadow for the bounds that two depths attain; Markov's after its distance.
TEST_CASE_TEMPLATE("an occluder over half of the filter region casts half a shadow", Format, EVERY_FORMAT)
{
    const auto near = load_channels<Format>(Format::encode(Format::from_depth(-0.5f)));
    const auto far = load_channels<Format>(Format::encode(Format::from_depth(0.5f)));
    channel_array<Format> mean;
    for (std::size_t k = 0; k < mean.size(); ++k) mean[k] = 0.5f * (near[k] + far[k]);
    const auto filtered = std::bit_cast<format_channels<Format>>(mean);
    // 16-bit roundings of the warped moments move the bound by 2 x 3 x 2^-11 at most.
    CHECK(std::abs(double(Format::intensity(filtered, 0.5f)) - 0.5) <= 0.01);
}

// A minimum variance of 99 e^2 darkens by 1% where the mean is off by e, three roundings of a depth.
TEST_CASE_TEMPLATE("channels of moments give these back", Format, moments4_unorm16, moments4_half, moments4_float)
{
    for (double z = -1; z < 1; z += 0.01) {
        const moments4<double> b = moments4_from_depth(z), back = Format::to_moments(Format::from_moments(b));
        CHECK(std::abs(back.b1 - b.b1) < 1e-15);
        CHECK(std::abs(back.b2 - b.b2) < 1e-15);
        CHECK(std::abs(back.b3 - b.b3) < 1e-15);
        CHECK(std::abs(back.b4 - b.b4) < 1e-15);
    }
}

TEST_CASE("the settings of formats are those that their comments derive")
{
    const auto against = [](double rounding) { return 99 * (3 * rounding) * (3 * rounding); };
    const auto equal = [](double value, double derived) { CHECK(std::abs(value / derived - 1) <= 4 * 0x1p-53); };
    equal(variance_unorm16_minimum_variance, against(1 / 65535.0));
    equal(exponential_variance_half_minimum_variance, against(0x1p-11 / exponential_variance_half_exponent));
    equal(exponential_variance_float_minimum_variance,
          against(0x1p-24 + 0x1p-24 / exponential_variance_float_negative_exponent));
    equal(layered_variance_unorm16_minimum_variance, 3 * (0.5 + 2) / 65535);
    const convolution_settings<double> series{16, 0, convolution_unorm8_offset, 0.9375};
    equal(series.offset, 1.9264476603173706 / (3.1415926535897932 * series.terms * series.span));
    const std::array weights{convolution_unorm8_weight1,  convolution_unorm8_weight2,  convolution_unorm8_weight3,
                             convolution_unorm8_weight4,  convolution_unorm8_weight5,  convolution_unorm8_weight6,
                             convolution_unorm8_weight7,  convolution_unorm8_weight8,  convolution_unorm8_weight9,
                             convolution_unorm8_weight10, convolution_unorm8_weight11, convolution_unorm8_weight12,
                             convolution_unorm8_weight13, convolution_unorm8_weight14, convolution_unorm8_weight15,
                             convolution_unorm8_weight16};
    for (std::size_t k = 0; k < weights.size(); ++k) CHECK(weights[k] == convolution_weight(double(k + 1), series));
    CHECK(std::isfinite(half_decode(half_encode(float(std::exp(2 * exponential_variance_half_exponent))))));
}

TEST_CASE("the centred series is that without an offset, 1/2 at the depth of the texel")
{
    for (int k = -19; k < 20; ++k) {
        const double z = 0.05 * k;
        const auto channels = convolution_unorm8_encode(z);
        CHECK(convolution_unorm8_centred_intensity(channels, z) == doctest::Approx(0.5));
        for (const double z_f : {-0.9, -0.2, 0.3, 0.9})
            CHECK(convolution_unorm8_centred_intensity(channels, z_f) ==
                  doctest::Approx(convolution_unorm8_intensity(channels, z_f + convolution_unorm8_offset)));
    }
}
