// Blur, mips and look-ups against sums in double over every texel, for storage formats of all kinds; and the answers to
// bad shapes.
#include "support/effort.hpp"

#include <gnomon/passes/blur.hpp>
#include <gnomon/passes/look_up.hpp>
#include <gnomon/passes/mips.hpp>
#include <gnomon/storage/formats.hpp>

#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <random>
#include <vector>

using namespace gnomon;

namespace {

std::size_t draw(std::mt19937& random, std::size_t low, std::size_t high)
{
    return std::uniform_int_distribution<std::size_t>(low, high)(random);
}

/// Error of a value that the format stores: half a step, relative for floats.
template <class Format> double storage_error(double value)
{
    constexpr std::string_view name = Format::name;
    if (name.ends_with("8 UNORM")) return 0.5 / 255;
    if (name.ends_with("10 UNORM")) return 0.5 / 1023;
    if (name.ends_with("16 UNORM")) return 0.5 / 65535;
    if (name.ends_with("half")) return std::abs(value) * 0x1p-11 + 0x1p-25;
    return std::abs(value) * 0x1p-24;
}

template <class Format> struct random_map {
    std::vector<format_texel<Format>> texels;
    map_view<format_texel<Format>> view;

    random_map(std::mt19937& random, std::size_t width, std::size_t height, std::size_t stride)
        : texels(stride * height)
    {
        // Channels that the format holds exactly, of both signs where it has them.
        for (auto& t : texels) {
            channel_array<Format> c;
            for (float& value : c) value = std::uniform_real_distribution<float>(-0.25f, 1)(random);
            t = store_channels<Format>(c);
        }
        view = {texels, width, height, stride};
    }
};

std::vector<float> random_weights(std::mt19937& random, std::size_t taps)
{
    std::vector<float> weights(taps);
    float sum = 0;
    for (float& w : weights) sum += w = std::uniform_real_distribution<float>(0, 1)(random);
    for (float& w : weights) w /= sum;
    return weights;
}

using wide_sum = std::vector<double>;

/// sum_k weight_k channels_k in double.
template <class Format> void add(wide_sum& sum, double weight, const format_texel<Format>& t)
{
    const auto c = load_channels<Format>(t);
    for (std::size_t k = 0; k < c.size(); ++k) sum[k] += weight * double(c[k]);
}

/// A float sum of n products with weights that sum to 1 and values of at most 1 is within (n + 2) 2^-24.
template <class Format> void check_texel(const format_texel<Format>& t, const wide_sum& expected, std::size_t n)
{
    const auto c = load_channels<Format>(t);
    for (std::size_t k = 0; k < c.size(); ++k)
        REQUIRE(std::abs(double(c[k]) - expected[k]) <= storage_error<Format>(expected[k]) + double(n + 2) * 0x1p-24);
}

std::size_t clamped(std::ptrdiff_t i, std::size_t extent)
{
    return std::size_t(std::clamp<std::ptrdiff_t>(i, 0, std::ptrdiff_t(extent) - 1));
}

template <class T> bool same_bytes(const std::vector<T>& a, const std::vector<T>& b)
{
    return std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

} // namespace

#define EVERY_KIND_OF_FORMAT                                                                              \
    variance_unorm16, exponential_float, exponential_variance_half, convolution_unorm8, moments4_unorm16, \
        moments4_float, moments6_unorm10

TEST_CASE_TEMPLATE("blur equals the sum over its taps, in bands of rows, with strides", Format, EVERY_KIND_OF_FORMAT)
{
    std::mt19937 random(1);
    for (std::int64_t round = 0; round < std::max<std::int64_t>(test::effort(40), 4); ++round) {
        const std::size_t width = draw(random, 1, 70), height = draw(random, 1, 30);
        const random_map<Format> source(random, width, height, width + draw(random, 0, 3));
        random_map<Format> along_x(random, width, height, width + draw(random, 0, 3));
        random_map<Format> along_y(random, width, height, width);
        const auto weights = random_weights(random, 2 * draw(random, 0, round % 8 == 0 ? 31 : 6) + 1);
        const std::size_t split = draw(random, 0, height);
        for (const row_range rows : {row_range{split, height}, row_range{0, split}}) {
            blur_along_x<Format>(source.view, along_x.view, weights, rows);
            blur_along_y<Format>(source.view, along_y.view, weights, rows);
        }
        const auto radius = std::ptrdiff_t(weights.size() / 2);
        for (std::size_t y = 0; y < height; ++y) {
            for (std::size_t x = 0; x < width; ++x) {
                wide_sum sum_x(channel_count<Format>), sum_y(channel_count<Format>);
                for (std::ptrdiff_t t = -radius; t <= radius; ++t) {
                    const auto weight = double(weights[std::size_t(t + radius)]);
                    add<Format>(sum_x, weight, source.view(clamped(std::ptrdiff_t(x) + t, width), y));
                    add<Format>(sum_y, weight, source.view(x, clamped(std::ptrdiff_t(y) + t, height)));
                }
                check_texel<Format>(along_x.view(x, y), sum_x, weights.size());
                check_texel<Format>(along_y.view(x, y), sum_y, weights.size());
            }
        }
    }
}

TEST_CASE("blur is both passes, also in place; padding stays untouched; a constant map stays constant")
{
    using format = moments4_unorm16;
    std::mt19937 random(2);
    random_map<format> map(random, 37, 23, 40);
    random_map<format> scratch(random, 37, 23, 37), first(random, 37, 23, 37), second(random, 37, 23, 40);
    const auto weights = gaussian_weights();
    double sum = 0;
    for (const float w : weights) sum += double(w);
    CHECK(std::abs(sum - 1) <= 9 * 0x1p-25);
    CHECK(weights[4] / weights[2] == doctest::Approx(std::exp(0.5)));
    blur_along_x<format>(map.view, first.view, weights, {0, 23});
    const auto padding = second.texels[39];
    blur_along_y<format>(first.view, second.view, weights, {0, 23});
    CHECK(second.texels[39] == padding);
    blur<format>(map.view, scratch.view, map.view, weights);
    for (std::size_t y = 0; y < 23; ++y)
        for (std::size_t x = 0; x < 37; ++x) REQUIRE(map.view(x, y) == second.view(x, y));
    for (auto& t : map.texels) t = format::encode(format::from_depth(0.3f));
    const auto constant = map.texels;
    blur<format>(map.view, scratch.view, map.view, weights);
    CHECK(same_bytes(map.texels, constant));
}

TEST_CASE_TEMPLATE("mips: the mean over the area that a texel covers, for any extent", Format, EVERY_KIND_OF_FORMAT)
{
    std::mt19937 random(3);
    for (std::int64_t round = 0; round < std::max<std::int64_t>(test::effort(40), 4); ++round) {
        const std::size_t width = draw(random, 1, 40), height = draw(random, 1, 40);
        std::vector<format_texel<Format>> texels(mip_texels(width, height));
        const random_map<Format> base(random, width, height, width);
        std::copy(base.texels.begin(), base.texels.end(), texels.begin());
        const mip_view<format_texel<Format>> mips{texels, width, height};
        build_mips<Format>(mips);
        CHECK(mips.level(mips.levels() - 1).texels.size() == 1);
        for (std::size_t level = 1; level < mips.levels(); ++level) {
            const auto fine = mips.level(level - 1), coarse = mips.level(level);
            const double sx = double(fine.width) / double(coarse.width),
                         sy = double(fine.height) / double(coarse.height);
            for (std::size_t y = 0; y < coarse.height; ++y) {
                for (std::size_t x = 0; x < coarse.width; ++x) {
                    const auto overlap = [](double begin, double end, std::size_t i) {
                        return std::max(0.0, std::min(end, double(i + 1)) - std::max(begin, double(i)));
                    };
                    wide_sum sum(channel_count<Format>);
                    for (std::size_t j = 0; j < fine.height; ++j)
                        for (std::size_t i = 0; i < fine.width; ++i) {
                            const double area = overlap(double(x) * sx, double(x + 1) * sx, i) *
                                                overlap(double(y) * sy, double(y + 1) * sy, j);
                            if (area > 0) add<Format>(sum, area / (sx * sy), fine(i, j));
                        }
                    check_texel<Format>(coarse(x, y), sum, 9);
                }
            }
        }
    }
}

// A value within [-0.25, 1] is interpolated by three differences, each with three roundings of at most 1.25 2^-24 x 2.
TEST_CASE_TEMPLATE("look-ups: bilinear between texel centres, linear between levels", Format, EVERY_KIND_OF_FORMAT)
{
    std::mt19937 random(4);
    const std::size_t width = 13, height = 6;
    std::vector<format_texel<Format>> texels(mip_texels(width, height));
    const random_map<Format> base(random, width, height, width);
    std::copy(base.texels.begin(), base.texels.end(), texels.begin());
    const mip_view<format_texel<Format>> mips{texels, width, height};
    build_mips<Format>(mips);
    const auto bilinear_sum = [](map_view<const format_texel<Format>> map, double x, double y, wide_sum& sum,
                                 double share) {
        x = std::clamp(x - 0.5, 0.0, double(map.width - 1));
        y = std::clamp(y - 0.5, 0.0, double(map.height - 1));
        for (std::size_t j = 0; j < map.height; ++j)
            for (std::size_t i = 0; i < map.width; ++i)
                add<Format>(
                    sum,
                    share * std::max(0.0, 1 - std::abs(x - double(i))) * std::max(0.0, 1 - std::abs(y - double(j))),
                    map(i, j));
    };
    // Positions have 2^-20 of a texel and a fraction's error moves the value by as much; scaled ones round once more.
    const double tolerance = 24 * 0x1p-24 + 4 * 0x1p-20;
    for (std::int64_t i = 0; i < test::effort(4000); ++i) {
        const float x = std::uniform_real_distribution<float>(-2, 15)(random),
                    y = std::uniform_real_distribution<float>(-2, 8)(random);
        const float level = std::uniform_real_distribution<float>(-1, 5)(random);
        const auto flat = std::bit_cast<channel_array<Format>>(bilinear<Format>(mips.level(0), x, y));
        const auto deep = std::bit_cast<channel_array<Format>>(trilinear<Format>(mips, x, y, level));
        wide_sum flat_sum(channel_count<Format>), deep_sum(channel_count<Format>);
        bilinear_sum(mips.level(0), double(x), double(y), flat_sum, 1);
        for (std::size_t k = 0; k < mips.levels(); ++k) {
            const double share =
                std::max(0.0, 1 - std::abs(std::clamp(double(level), 0.0, double(mips.levels() - 1)) - double(k)));
            const auto map = mips.level(k);
            if (share > 0)
                bilinear_sum(map, double(x) * double(map.width) / width, double(y) * double(map.height) / height,
                             deep_sum, share);
        }
        for (std::size_t k = 0; k < flat.size(); ++k) {
            REQUIRE(std::abs(double(flat[k]) - flat_sum[k]) <= tolerance);
            REQUIRE(std::abs(double(deep[k]) - deep_sum[k]) <= tolerance);
        }
    }
    const float infinity = std::numeric_limits<float>::infinity();
    const auto bytes = [](const auto& c) { return std::bit_cast<channel_array<Format>>(c); };
    CHECK(bytes(bilinear<Format>(mips.level(0), -1e9f, -infinity)) == load_channels<Format>(texels[0]));
    CHECK(bytes(trilinear<Format>(mips, infinity, infinity, 0)) == load_channels<Format>(texels[width * height - 1]));
    CHECK(bytes(trilinear<Format>(mips, 3, -7, infinity)) == load_channels<Format>(texels.back()));
}

TEST_CASE("shapes that do not fit are refused with both values, before anything is written")
{
    using format = exponential_float;
    using texel = format::texel;
    std::vector<texel> a(20, texel{1.0f}), b(20, texel{2.0f});
    const std::vector<texel> before = b;
    const map_view<const texel> source(a, 5, 4);
    const auto weights = gaussian_weights<5>();
    const auto blurs = [&](map_view<const texel> s, map_view<texel> t, std::span<const float> w, row_range rows,
                           const char* message) {
        CHECK_THROWS_WITH_AS(blur_along_x<format>(s, t, w, rows), message, std::invalid_argument);
        CHECK_THROWS_WITH_AS(blur_along_y<format>(s, t, w, rows), message, std::invalid_argument);
        CHECK(b == before);
    };
    blurs(source, {b, 4, 4}, weights, {0, 4}, "gnomon: blur: target.width is 4, but source.width is 5");
    blurs(source, {b, 5, 3}, weights, {0, 3}, "gnomon: blur: target.height is 3, but source.height is 4");
    blurs(source, {b, 5, 5}, weights, {0, 4}, "gnomon: blur: target.texels.size() is 20, but target.height is 5");
    blurs(source, {b, 5, 4, 4}, weights, {0, 4}, "gnomon: blur: target.stride is 4, but target.width is 5");
    blurs(source, {b, 0, 4}, weights, {0, 4}, "gnomon: blur: target.width is 0, but target.height is 4");
    blurs(source, {b, 5, std::size_t(-1), std::size_t(1) << 63}, weights, {0, 4},
          "gnomon: blur: target.texels.size() is 20, but target.height is 18446744073709551615");
    blurs(source, {b, 5, 4}, std::span<const float>(weights).first(4), {0, 4},
          "gnomon: blur: weights.size() is 4, but its remainder by 2 is 0");
    blurs(source, {b, 5, 4}, std::span<const float>(weights).first(0), {0, 4},
          "gnomon: blur: weights.size() is 0, but its remainder by 2 is 0");
    const std::vector<float> many(65, 0.0f);
    blurs(source, {b, 5, 4}, many, {0, 4}, "gnomon: blur: weights.size() is 65, but maximum_blur_taps is 63");
    blurs(source, {b, 5, 4}, weights, {0, 5}, "gnomon: blur: rows.last is 5, but target.height is 4");
    blurs(source, {b, 5, 4}, weights, {3, 2}, "gnomon: blur: rows.first is 3, but rows.last is 2");
    const map_view<texel> half(std::span<texel>(b).first(10), 5, 2);
    const map_view<const texel> overlapping(std::span<texel>(b).subspan(5, 10), 5, 2);
    blurs(overlapping, half, weights, {0, 2},
          "gnomon: blur: target begins inside source or before its end: target.texels.size() is 10, but "
          "source.texels.size() is 10");
    CHECK_THROWS_WITH_AS(blur<format>(source, {b, 4, 4}, {b, 5, 4}, weights),
                         "gnomon: blur: target.width is 4, but source.width is 5", std::invalid_argument);
    CHECK_THROWS_WITH_AS(downsample<format>(source, {b, 3, 2}, {0, 2}),
                         "gnomon: downsample: target.width is 3, but source.width is 5", std::invalid_argument);
    CHECK_THROWS_WITH_AS(downsample<format>(source, {b, 2, 1}, {0, 1}),
                         "gnomon: downsample: target.height is 1, but source.height is 4", std::invalid_argument);
    CHECK_THROWS_WITH_AS(build_mips<format>({b, 4, 4}),
                         "gnomon: build_mips: mips.texels.size() is 20, but mip_texels is 21", std::invalid_argument);
    CHECK_THROWS_WITH_AS(build_mips<format>({b, 4, 0}), "gnomon: build_mips: mips.width is 4, but mips.height is 0",
                         std::invalid_argument);
    CHECK(b == before);
}
