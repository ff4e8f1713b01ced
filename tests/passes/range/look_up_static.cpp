// Look-ups of static receivers in maps of ranges: one by one and many at a time, wide filters against the mean of
// narrow ones, and places outside of the map.
#include "random_maps.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

TEST_CASE_TEMPLATE(
    "static_intensity is moving_intensity of a path of no length; a wide filter is the mean of narrow ones", T, float,
    double)
{
    bit_source bits(62);
    const double u = double(std::numeric_limits<T>::epsilon());
    for (std::int64_t n = 0; n < test::effort(500); ++n) {
        const random_map<T> random(bits);
        receiver_path<T> path = any_path<T>(bits);
        path.x1 = path.x0, path.y1 = path.y0, path.depth.z1 = path.depth.z0;
        const auto at_place = [&](T x, T y, int look_ups) {
            const auto state = static_receiver_begin(path.depth.z0, path.depth.id, path.depth.t0, path.depth.t1);
            return double(static_intensity(random.map(), x, y, state, look_ups));
        };
        const double one = at_place(path.x0, path.y0, 1);
        // Ranges at almost the receiver's depth cross it at times that rounding moves.
        const double slack = 1e4 * u;
        CHECK(std::abs(double(moving_intensity(random.map(), path, path.depth.t0, path.depth.t1)) - one) <= slack);
        double mean = 0;
        for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i) mean += at_place(path.x0 + T(i), path.y0 + T(j), 1) / 9;
        CHECK(std::abs(at_place(path.x0, path.y0, 3) - mean) <= slack);
    }
}

TEST_CASE_TEMPLATE("static_intensities has the bits of static_intensity, for lists of any length", T, float, double)
{
    bit_source bits(64);
    for (std::int64_t n = 0; n < test::effort(200); ++n) {
        const random_map<T> random(bits);
        const int look_ups = 1 + int(bits.below(8)); // 81 lists for each receiver fill the queue several times
        std::vector<placed_receiver<T>> receivers(bits.below(300));
        for (auto& r : receivers)
            r = {T(bits.uniform(-2, 14)), T(bits.uniform(-2, 12)),
                 static_receiver_begin(T(bits.uniform(-1, 1)), T(bits.below(5)), T(0), T(bits.uniform(0.5, 1)))};
        if (!receivers.empty()) receivers[0].x = std::numeric_limits<T>::quiet_NaN();
        std::vector<T> found(receivers.size());
        static_intensities<T>(random.map(), receivers, found, look_ups);
        for (std::size_t i = 0; i < found.size(); ++i)
            REQUIRE(found[i] ==
                    static_intensity(random.map(), receivers[i].x, receivers[i].y, receivers[i].state, look_ups));
    }
}

TEST_CASE_TEMPLATE("summaries change only roundings, one by one and many at a time", T, float, double)
{
    bit_source bits(66);
    std::int64_t behind = 0, before = 0;
    for (std::int64_t n = 0; n < test::effort(200); ++n) {
        random_map<T> random(bits);
        random.fill(bits);
        std::vector<range_summary<T>> summaries;
        const range_map<T> with_summaries = random.with_summaries(summaries);
        const int look_ups = 1 + int(bits.below(3));
        std::vector<placed_receiver<T>> receivers(bits.below(100));
        for (auto& r : receivers) {
            const T begin = bits.chance(0.5) ? T(0.25) : T(0); // most summaries decide only for the whole shutter
            r = {T(bits.uniform(-2, 14)), T(bits.uniform(-2, 12)),
                 static_receiver_begin(T(bits.uniform(-1, 1.5)), T(9), begin, T(1))};
        }
        std::vector<T> found(receivers.size());
        static_intensities<T>(with_summaries, receivers, found, look_ups);
        // 16 texels with at most 11 spans of 6 ranges, 4 roundings for each span.
        const T slack = T(16 * 11 * 4) * std::numeric_limits<T>::epsilon();
        for (std::size_t i = 0; i < found.size(); ++i) {
            const auto& [x, y, state] = receivers[i];
            const T expected = static_intensity(random.map(), x, y, state, look_ups);
            REQUIRE(std::abs(static_intensity(with_summaries, x, y, state, look_ups) - expected) <= slack);
            REQUIRE(std::abs(found[i] - expected) <= slack);
            (state.depth > 1 ? behind : before) += expected > 0;
        }
    }
    CHECK(behind > 0);
    CHECK(before > 0);
}

#if defined(__cpp_exceptions)
TEST_CASE("static_intensities and set_summaries refuse arguments that do not fit, before they write")
{
    bit_source bits(65);
    const random_map<float> random(bits);
    const std::vector<placed_receiver<float>> receivers(2);
    std::vector<float> shadows(1, 7.f);
    CHECK_THROWS_WITH_AS(static_intensities<float>(random.map(), receivers, shadows),
                         doctest::Contains("shadows.size() is 1, but receivers.size() is 2"), std::invalid_argument);
    shadows.push_back(7);
    range_map<float> map = random.map();
    map.width += map.tile;
    CHECK_THROWS_WITH_AS(static_intensities<float>(map, receivers, shadows),
                         doctest::Contains("static_intensities: map.first.size() is"), std::invalid_argument);
    map = random.map();
    map.ranges = map.ranges.first(map.ranges.size() - 1);
    CHECK_THROWS_WITH_AS(static_intensities<float>(map, receivers, shadows),
                         doctest::Contains("but map.ranges.size() is"), std::invalid_argument);
    map = random.map();
    std::vector<range_summary<float>> summaries(map.first.size()), few(3);
    map.summaries = summaries;
    CHECK_THROWS_WITH_AS(static_intensities<float>(map, receivers, shadows),
                         doctest::Contains("static_intensities: map.summaries.size() + 1 is"), std::invalid_argument);
    CHECK_THROWS_WITH_AS(set_summaries(random.map(), std::span(few), range_ids::any),
                         doctest::Contains("range summaries: summaries.size() + 1 is 4"), std::invalid_argument);
    CHECK(shadows == std::vector<float>(2, 7.f));
}
#endif

TEST_CASE_TEMPLATE("outside of the map, and at NaN, a receiver is lit; a tent shutter", T, float, double)
{
    const T nan = std::numeric_limits<T>::quiet_NaN();
    std::vector<std::uint32_t> texels;
    std::vector<depth_time_range<T>> all;
    for (std::size_t i = 0; i < width * height; ++i) {
        texels.push_back(std::uint32_t(range_map<T>::texel(width, i % width, i / width)));
        all.push_back({T(0), T(0.5), T(-1), T(-1), T(1)});
    }
    std::vector<std::uint32_t> first(range_map<T>::texels(width, height) + 1);
    std::vector<depth_time_range<T>> ranges(all.size());
    sort_into_lists<T>(texels, all, first, ranges);
    const range_map<T> map{width, height, first, ranges};
    const auto state = static_receiver_begin(T(0), T(2), T(0), T(1));
    CHECK(static_intensity(map, T(6), T(5), state) == T(0.5));
    CHECK(static_intensity(map, T(6), T(5), state, 4) == doctest::Approx(0.5));
    CHECK(static_intensity(map, T(0), T(5), state) == T(0.25));
    CHECK(static_intensity(map, T(width), T(height), state) == T(0.125));
    CHECK(static_intensity(map, T(-9), T(5), state) == 0);
    CHECK(static_intensity(map, T(1e30), T(-1e30), state) == 0);
    CHECK(static_intensity(map, nan, T(5), state) == 0);
    CHECK(static_intensity(map, T(6), T(5), static_receiver_begin(T(0), T(2), T(0.25), T(1)), 1, tent_shutter{}) ==
          doctest::Approx(2.0 / 9));
    const receiver_path<T> lost{{T(0), T(1), T(0), T(0), T(2)}, nan, T(5), T(1), T(6), T(5), T(1)};
    CHECK(moving_intensity(map, lost, T(0), T(1)) == 0);
    CHECK(intensity_at(map, lost, T(0.25), T(0)) == 0);
    const T sampled = sampled_intensity(map, lost, T(0), T(64));
    CHECK((sampled >= 0 && sampled <= 1));
}
