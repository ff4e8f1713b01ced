// Degenerate parameters of passes: each means its limit, or is refused by name before anything is written.
#include "support/formats.hpp"

#include <gnomon/passes/blur.hpp>
#include <gnomon/passes/look_up.hpp>
#include <gnomon/passes/range/join.hpp>
#include <gnomon/passes/range/look_up.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN(),
                 infinity = std::numeric_limits<double>::infinity();

template <std::size_t taps> void check_gaussian()
{
    CAPTURE(taps);
    for (const double sigma : {0.0, -0.0, 1e-320, 1e-160, nan_value}) {
        const auto weights = gaussian_weights<taps>(sigma);
        for (std::size_t k = 0; k < taps; ++k) CHECK(weights[k] == (k == taps / 2 ? 1 : 0));
    }
    for (const double sigma : {infinity, -infinity, 1e200})
        for (const float w : gaussian_weights<taps>(sigma)) CHECK(w == 1 / float(taps));
    for (const double sigma : {1e-3, 0.3, 2.0, 100.0}) {
        const auto weights = gaussian_weights<taps>(sigma);
        CHECK(weights == gaussian_weights<taps>(-sigma));
        double sum = 0;
        for (const float w : weights) {
            CHECK((0 <= w && w <= 1));
            sum += double(w);
        }
        CHECK(std::abs(sum - 1) <= double(taps) * 0x1p-25);
    }
}

} // namespace

TEST_CASE("Gaussian weights: no sigma is the middle tap, an infinite one a box; one tap has weight 1")
{
    check_gaussian<1>();
    check_gaussian<3>();
    check_gaussian<9>();
    check_gaussian<63>();
    CHECK(gaussian_weights<1>() == std::array{1.0f});
}

TEST_CASE("the middle tap alone changes no texel, and a filter wider than its map gives the map's mean")
{
    for_each_format([]<storage_format Format>() {
        CAPTURE(Format::id);
        std::vector<format_texel<Format>> texels(7 * 5), scratch(texels);
        for (std::size_t k = 0; k < texels.size(); ++k) texels[k] = texel_of_depth<Format>(float(k) / 35 - 0.5f);
        const auto before = texels;
        blur<Format>({texels, 7, 5}, {scratch, 7, 5}, {texels, 7, 5}, gaussian_weights<5>(0));
        blur<Format>({texels, 7, 5}, {scratch, 7, 5}, {texels, 7, 5}, gaussian_weights<1>());
        const bool same = std::memcmp(texels.data(), before.data(), sizeof texels[0] * texels.size()) == 0;
        CHECK(same);
        std::vector<format_texel<Format>> one{texel_of_depth<Format>(0.25f)}, room(1);
        blur<Format>({one, 1, 1}, {room, 1, 1}, {one, 1, 1}, gaussian_weights<63>());
        CHECK(larger_intensity<Format>(Format::decode(one[0]), 0.25f) <= larger_darkening<Format>());
        CHECK(larger_intensity<Format>(Format::decode(one[0]), 1.0f) >= 0.94);
        std::vector<format_texel<Format>> mips(one);
        build_mips<Format>({mips, 1, 1});
        CHECK(same_bytes(mips[0], one[0]));
    });
}

TEST_CASE("weights that do not sum to 1 are refused, before anything is written")
{
    using format = exponential_float;
    std::vector<format::texel> a(20, format::texel{1.0f}), b(20, format::texel{2.0f});
    const auto before = b;
    const float nan = float(nan_value), inf = float(infinity);
    for ([[maybe_unused]] const auto& [weights, message] :
         {std::pair<std::array<float, 3>, const char*>{
              {0, 0, 0}, "gnomon: blur: the sum of weights is 0.000000, but a filter needs 1"},
          {{-1, 0, 1}, "gnomon: blur: the sum of weights is 0.000000, but a filter needs 1"},
          {{0.5f, 1, 0.5f}, "gnomon: blur: the sum of weights is 2.000000, but a filter needs 1"},
          {{0, nan, 0}, "gnomon: blur: the sum of weights is nan, but a filter needs 1"},
          {{inf, 1, 0}, "gnomon: blur: the sum of weights is inf, but a filter needs 1"}}) {
        CHECK_THROWS_WITH_AS((blur_along_x<format>({a, 5, 4}, {b, 5, 4}, weights, {0, 4})), message,
                             std::invalid_argument);
        CHECK_THROWS_WITH_AS((blur_along_y<format>({a, 5, 4}, {b, 5, 4}, weights, {0, 4})), message,
                             std::invalid_argument);
        CHECK(b == before);
    }
}

TEST_CASE("numbers of look-ups in a map of ranges that are not possible are refused")
{
    std::vector<std::uint32_t> first(range_map<float>::texels(2, 2) + 1, 4);
    const std::vector<depth_time_range<float>> ranges(4, {0, 1, -0.5f, -0.5f, 3});
    for (std::uint32_t y = 0, n = 0; y < 2; ++y)
        for (std::uint32_t x = 0; x < 2; ++x, ++n) first[range_map<float>::texel(2, x, y)] = n;
    // Texels are counted by blocks, so lists of texels outside of the map are empty.
    for (std::size_t k = 0; k + 1 < first.size(); ++k)
        if (k > 1 && k != 4 && k != 5) first[k] = k < 4 ? 2 : 4;
    const range_map<float> map{2, 2, first, ranges};
    const auto receiver = static_receiver_begin(0.f, 1.f, 0.f, 1.f);
    const receiver_path<float> path{{0, 1, 0, 0, 1}, 1, 1, 1, 1, 1, 1};
    const std::vector<placed_receiver<float>> placed{{1, 1, receiver}};
    std::vector<float> shadows{0.25f};
    for (const int look_ups : {0, -1, 4097, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()}) {
        const std::string end = ": look_ups is " + std::to_string(look_ups) + ", but 1 to 4096 are possible";
        CHECK_THROWS_WITH_AS(static_intensity(map, 1.f, 1.f, receiver, look_ups),
                             ("gnomon: static_intensity" + end).c_str(), std::invalid_argument);
        CHECK_THROWS_WITH_AS(static_intensities<float>(map, placed, shadows, look_ups),
                             ("gnomon: static_intensities" + end).c_str(), std::invalid_argument);
        CHECK_THROWS_WITH_AS(moving_intensity(map, path, 0.f, 1.f, look_ups),
                             ("gnomon: moving_intensity" + end).c_str(), std::invalid_argument);
        CHECK_THROWS_WITH_AS(intensity_at(map, path, 0.5f, 0.f, look_ups), ("gnomon: intensity_at" + end).c_str(),
                             std::invalid_argument);
        CHECK(shadows[0] == 0.25f);
    }
    CHECK(static_intensity(map, 1.f, 1.f, receiver, 1) == 1);
    CHECK(static_intensity(map, 1.f, 1.f, receiver, 4096) == doctest::Approx(4 / (4096.0 * 4096)));
    CHECK(static_intensity(range_map<float>{0, 0, std::span(first).first(1), {}}, 1.f, 1.f, receiver, 1) == 0);
    // An exposure or a path of no length shows one time; samples are 5 to 2^20.
    CHECK(moving_intensity(map, path, 0.5f, 0.5f) == doctest::Approx(1).epsilon(1e-5));
    const receiver_path<float> brief{{0.5f, 0.5f, 0, 0, 1}, 1, 1, 1, 1, 1, 1};
    CHECK(moving_intensity(map, brief, 0.f, 1.f) <= 1);
    for (const float most : {0.f, -1.f, 5.f, float(infinity), float(nan_value)})
        CHECK(sampled_intensity(map, path, 0.f, most) == doctest::Approx(1));
}

TEST_CASE("a tolerance beyond the whole range of depth joins as that does")
{
    const auto joined = [](float tolerance) {
        std::vector<depth_time_range<float>> list{{0, 0.5f, -1, -1, 1}, {0.5f, 1, 1, 1, 1}};
        list.resize(join_ranges(std::span(list), tolerance, [](const auto&, const auto&) { return true; }).size());
        return list;
    };
    for (const float tolerance : {0.f, -1.f, -float(infinity), float(nan_value)}) CHECK(joined(tolerance).size() == 2);
    for (const float tolerance : {2.f, 3.f, 1e30f, float(infinity)}) {
        const auto list = joined(tolerance);
        CHECK(list.size() == joined(2).size());
        for (const auto& r : list) CHECK((std::abs(r.z0) <= 3 && std::abs(r.z1) <= 3));
    }
}
