// Deep shadow maps: counted and filled from samples and from ranges, and looked up, against percentage-closer filtering of
// all samples and static receivers. Moment maps of ranges, and footprints in time.
#include "range/random_maps.hpp"

#include <gnomon/passes/deep_shadow.hpp>
#include <gnomon/passes/range/footprint.hpp>
#include <gnomon/passes/range/moments.hpp>
#include <gnomon/storage/moments4.hpp>

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

template <class T> struct deep_map {
    std::vector<std::uint32_t> first = std::vector<std::uint32_t>(width * height + 1);
    std::vector<deep_layer<T>> layers;

    deep_map(std::vector<T> depths, std::size_t samples, T tolerance)
    {
        count_deep_layers(std::span(depths), samples, tolerance, std::span(first));
        layers.resize(first.back());
        fill_deep_layers<T>(depths, samples, tolerance, first, std::span(layers));
    }
    deep_map(const range_map<T>& from, T tolerance)
    {
        count_deep_layers(from, tolerance, std::span(first));
        layers.resize(first.back());
        fill_deep_layers<T>(from, tolerance, first, std::span(layers));
    }
    deep_shadow_map<T> map() const { return {width, height, first, layers}; }
};

} // namespace

TEST_CASE("deep_shadow: within the tolerance of percentage-closer filtering of all samples")
{
    CHECK(rc::check("random depths in few layers, some unknown", [](std::uint64_t seed) {
        bit_source bits(seed);
        const std::size_t samples = 1 + bits.below(64);
        std::vector<float> depths(width * height * samples);
        for (float& z : depths)
            z = bits.chance(0.1) ? std::numeric_limits<float>::quiet_NaN()
                : bits.chance(0.3)
                    ? 1.f
                    : float(double(bits.below(3)) / 4 - 0.5 + (bits.chance(0.5) ? 0 : bits.uniform(0, 0.2)));
        const float tolerance = bits.chance(0.3) ? 0 : float(bits.uniform(0, 0.2));
        const deep_map<float> deep(depths, samples, tolerance);
        RC_ASSERT(deep.layers.size() <= depths.size());
        RC_ASSERT(std::all_of(deep.layers.begin(), deep.layers.end(), [](const auto& l) { return l.opacity > 0; }));
        for (int i = 0; i < 16; ++i) {
            const float x = float(bits.uniform(-1, width + 1)), y = float(bits.uniform(-1, height + 1));
            const float z = float(bits.uniform(-1, 1));
            const int look_ups = 1 + int(bits.below(3));
            double expected = 0;
            detail::for_each_static_texel(deep.map(), x, y, look_ups, [&](float weight, std::size_t texel) {
                for (std::size_t k = 0; k < samples; ++k)
                    expected += double(weight) * (depths[texel * samples + k] < z) / double(samples);
            });
            RC_ASSERT(std::abs(double(deep_intensity(deep.map(), x, y, z, look_ups)) - expected) <=
                      double(tolerance) + 1e-5);
        }
    }));
}

TEST_CASE_TEMPLATE("deep_shadow: of ranges within the tolerance of static receivers of no surface", T, float, double)
{
    bit_source bits(71);
    for (std::int64_t n = 0; n < effort(300); ++n) {
        const random_map<T> random(bits, bits.chance(0.5) ? range_ids::any : range_ids::surfaces);
        const T tolerance = bits.chance(0.5) ? T(0) : T(bits.uniform(0, 0.1));
        const deep_map<T> deep(random.map(), tolerance);
        for (int i = 0; i < 40; ++i) {
            const T x = T(bits.uniform(-1, width + 1)), y = T(bits.uniform(-1, height + 1)), z = T(bits.uniform(-1, 1));
            const int look_ups = 1 + int(bits.below(3));
            const T expected =
                static_intensity(random.map(), x, y, static_receiver_begin(z, T(range_nothing), T(0), T(1)), look_ups);
            CHECK(std::abs(double(deep_intensity(deep.map(), x, y, z, look_ups)) - double(expected)) <=
                  double(tolerance) + 1e-5);
        }
    }
}

TEST_CASE("deep_shadow: level ranges are steps, and cleared depths shadow nothing, behind them, too")
{
    std::vector<std::uint32_t> begins(range_map<float>::texels(width, height) + 1);
    std::vector<depth_time_range<float>> ranges;
    for (std::uint32_t& begin : begins) {
        begin = std::uint32_t(ranges.size());
        if (&begin == &begins.back()) break;
        ranges.push_back({0, 0.25f, -0.5f, -0.5f, 1});
        ranges.push_back({0.5f, 1, 0.25f, 0.25f, 2});
    }
    const deep_map<float> deep(range_map<float>{width, height, begins, ranges}, 0);
    const auto at = [&](float z) { return double(deep_intensity(deep.map(), 5.5f, 5.5f, z)); };
    CHECK((at(-0.5f) == 0 && at(-0.25f) == doctest::Approx(0.25) && at(0.5f) == doctest::Approx(0.75)));
    const deep_map<float> cleared(std::vector<float>(4 * width * height, 1.f), 4, 0.f);
    CHECK((cleared.layers.empty() && deep_intensity(cleared.map(), 5.5f, 5.5f, 2.f) == 0));
}

TEST_CASE("deep_shadow: shapes are checked, and layers counted with another tolerance stay in their texels")
{
    std::vector<float> depths(12, -0.5f);
    std::vector<std::uint32_t> first(4), wrong(3);
    std::vector<deep_layer<float>> layers(3), few(2);
    CHECK_THROWS_AS(count_deep_layers(std::span(depths), 4, 0.f, std::span(wrong)), std::invalid_argument);
    CHECK_THROWS_AS(count_deep_layers(std::span(depths), 5, 0.f, std::span(first)), std::invalid_argument);
    CHECK_THROWS_AS(count_deep_layers(std::span(depths), 0, 0.f, std::span(first)), std::invalid_argument);
    count_deep_layers(std::span(depths), 4, 0.f, std::span(first));
    CHECK(first == std::vector<std::uint32_t>{0, 1, 2, 3});
    CHECK_THROWS_AS(fill_deep_layers<float>(depths, 4, 0, first, std::span(few)), std::invalid_argument);
    CHECK_THROWS_AS(check_shape(deep_shadow_map<float>{3, 1, first, few}, "test"), std::invalid_argument);
    CHECK_THROWS_AS(check_shape(deep_shadow_map<float>{4, 1, first, layers}, "test"), std::invalid_argument);
    fill_deep_layers<float>(depths, 4, 0, first, std::span(layers));
    const deep_shadow_map<float> map{3, 1, first, layers};
    CHECK_NOTHROW(check_shape(map, "test"));
    CHECK(deep_intensity(map, 1.5f, 0.5f, 0.f) == 1);
    CHECK(deep_intensity(map, 1.5f, 0.5f, -0.5f) == 0);
    CHECK_THROWS_AS(deep_intensity(map, 1.5f, 0.5f, 0.f, 0), std::invalid_argument);

    for (std::size_t i = 0; i < depths.size(); ++i) depths[i] = float(i % 4) / 4 - 0.5f;
    count_deep_layers(std::span(depths), 4, 0.f, std::span(first));
    layers.assign(first.back(), {0, 0, 2});
    fill_deep_layers<float>(depths, 4, 1, first, std::span(layers));
    CHECK(std::all_of(layers.begin(), layers.end(), [](const auto& l) { return l.opacity <= 1; }));
    first = {0, 1, 2, 3};
    layers.assign(12, {0, 0, 2});
    fill_deep_layers<float>(depths, 4, 0, first, std::span(layers).first(3)); // for which these texels have 12
    for (std::size_t i = 0; i < layers.size(); ++i) CHECK((layers[i].opacity <= 1) == (i < 3));
}

TEST_CASE("range_moments: maps hold the moments of their lists, in the format")
{
    bit_source bits(72);
    const random_map<float> random(bits, range_ids::surfaces);
    using format = moments4_unorm16;
    std::vector<format::texel> texels(width * height);
    const map_view<format::texel> target(texels, width, height);
    fill_range_moments<format>(random.map(), target);
    for (std::size_t y = 0; y < height; ++y)
        for (std::size_t x = 0; x < width; ++x) {
            range_moments4<float> state = range_moments4_begin(1.f);
            for (const auto& r : random.map()(x, y)) state = range_moments4_add(state, r);
            CHECK(target(x, y) == format::encode(format::from_moments(range_moments4_end(state))));
        }
    CHECK_THROWS_AS(fill_range_moments<format>(random.map(), {texels, width - 1, height}), std::invalid_argument);
    CHECK_THROWS_AS(fill_range_moments<format>(random.map(), target, {0, height + 1}), std::invalid_argument);
}

TEST_CASE("footprints: each is the mean over the times of its exposure")
{
    bit_source bits(74);
    double squares = 0, of_whole = 0;
    for (std::int64_t n = 0; n < effort(100); ++n) {
        const random_map<double> random(bits);
        receiver_path<double> path = any_path<double>(bits);
        path.depth.t0 = 0, path.depth.t1 = 1;
        const shutter_exposure<double> exposure = footprint_stratum(bits.uniform(0, 1), double(2 + bits.below(4)));
        double mean = 0;
        constexpr int times = 256;
        for (int k = 0; k < times; ++k) {
            const double t = shutter_time(exposure.begin, exposure.end, (k + 0.5) / times);
            const texel_position<double> at = receiver_path_at(path, t);
            mean += static_intensity(random.map(), at.x, at.y,
                                     static_receiver_begin(range_depth(path.depth, t), path.depth.id, t, t)) /
                    times;
        }
        const double found = footprint_intensity(random.map(), path, exposure);
        CHECK(std::abs(found - mean) <= 0.05); // a few begins and ends of shadows fall between two times
        squares += (found - mean) * (found - mean);
        of_whole += std::pow(moving_intensity(random.map(), path, 0., 1.) - mean, 2);
    }
    CHECK(squares < 0.01 * of_whole);
}

TEST_CASE("footprints: static paths count for their own times, and a NaN in a path or an exposure is lit")
{
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::vector<std::uint32_t> begins(range_map<float>::texels(width, height) + 1);
    for (std::size_t i = 0; i < begins.size(); ++i) begins[i] = std::uint32_t(i);
    const std::vector<depth_time_range<float>> ranges(begins.back(), {0, 1, -0.5f, -0.5f, 1});
    const range_map<float> map{width, height, begins, ranges};
    for (const float moved : {0.f, 0.25f}) {
        const receiver_path<float> path{{0.25f, 0.5f, 0, 0, 9}, 3.25f, 3.25f, 1, 3.25f + moved, 3.25f, 1};
        CHECK(double(footprint_intensity(map, path, {0, 1})) == doctest::Approx(0.25));
        CHECK(double(footprint_intensity(map, path, {0.5f, 0.25f})) == doctest::Approx(1));
        CHECK(double(footprint_intensity(map, path, {0.25f, 0.75f})) == doctest::Approx(0.5));
        CHECK(footprint_intensity(map, path, {0.75f, 1}) == 0);
        CHECK(footprint_intensity(map, path, {0.25f, nan}) == 0);
        for (std::size_t k = 0; k < 11; ++k) {
            if (k == 4) continue; // an id of NaN is that of no surface
            receiver_path<float> unknown = path;
            std::memcpy(reinterpret_cast<char*>(&unknown) + k * sizeof(float), &nan, sizeof(float));
            CHECK(footprint_intensity(map, unknown, {0.25f, 0.5f}) == 0);
        }
    }
}

TEST_CASE_TEMPLATE("footprints: those of all strata are the whole shutter interval", T, float, double)
{
    bit_source bits(73);
    for (std::int64_t n = 0; n < effort(300); ++n) {
        const random_map<T> random(bits);
        for (int i = 0; i < 10; ++i) {
            receiver_path<T> path = any_path<T>(bits);
            path.depth.t0 = 0, path.depth.t1 = 1;
            if (bits.chance(0.3)) path.x1 = path.x0, path.y1 = path.y0, path.depth.z1 = path.depth.z0;
            const T count = T(1 + bits.below(8));
            const int look_ups = 1 + int(bits.below(2));
            double sum = 0;
            for (T k = 0; k < count; ++k) {
                const T t = stratified_time(k, count, T(bits.uniform(0, 1)));
                const shutter_exposure<T> stratum = footprint_stratum(t, count);
                CHECK(stratum.begin <= t);
                CHECK(t <= stratum.end);
                sum += double(footprint_intensity(random.map(), path, stratum, look_ups)) / double(count);
            }
            CHECK(std::abs(sum - double(moving_intensity(random.map(), path, T(0), T(1), look_ups))) <= 2e-3);
        }
    }
}
