// Look-ups of moving receivers in maps of ranges: the closed form against many times and against the fold of its
// kernels, parts of paths behind the light, and samples.
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

TEST_CASE_TEMPLATE("moving_intensity is the mean over many times", T, float, double)
{
    constexpr int times = 4096;
    bit_source bits(61);
    const std::int64_t cases = test::effort(100);
    double errors = 0;
    for (std::int64_t n = 0; n < cases; ++n) {
        const random_map<T> random(bits);
        const receiver_path<T> path = any_path<T>(bits);
        const int look_ups = 1 + int(bits.below(3));
        double sum = 0;
        for (int i = 0; i < times; ++i)
            sum += double(
                intensity_at(random.map(), path, receiver_sample_time(path, T(i), T(times), T(0.5)), T(0), look_ups));
        const double found = double(moving_intensity(random.map(), path, path.depth.t0, path.depth.t1, look_ups));
        // Some hundred times at which a range begins, ends or crosses the receiver are in reach, each with a weight of
        // at most 1 / K^2. Between them weights are polynomials: a sample in the middle is right to the square of its
        // share.
        CHECK(std::abs(found - sum / times) <= 300.0 / times / (look_ups * look_ups) + 1e-4);
        errors += std::abs(found - sum / times);
    }
    // Each such time is off by up to half a sample, at random, so three hundred of them by the root of their number.
    CHECK(errors / double(cases) <= std::sqrt(300.0 / 12) / times + 1e-4);
}

TEST_CASE_TEMPLATE("moving_intensity is the fold of its kernels, with summaries and without", T, float, double)
{
    bit_source bits(68);
    struct folded_box : box_shutter {};
    double hidden = 0;
    for (std::int64_t n = 0; n < test::effort(300); ++n) {
        random_map<T> random(bits);
        random.fill(bits);
        std::vector<range_summary<T>> summaries;
        const range_map<T> with_summaries = random.with_summaries(summaries);
        for (int k = 0; k < 20; ++k) {
            receiver_path<T> path = any_path<T>(bits);
            const T behind = T(bits.below(3));
            path.depth.z0 += behind, path.depth.z1 += behind, path.depth.id = T(bits.below(6));
            const int look_ups = 1 + int(bits.below(3));
            T begin = bits.chance(0.5) ? path.depth.t0 : T(bits.uniform(-0.2, 0.4)), end = T(bits.uniform(0.5, 1.2));
            if (bits.chance(0.2)) std::swap(begin, end);
            const T expected = moving_intensity(random.map(), path, begin, end, look_ups, folded_box{});
            // Each of some hundred spans has an error of some hundred roundings times its share of the time. Spans at
            // almost the receiver's depth cross it at times that rounding moves.
            const T slack = T(1e4) * std::numeric_limits<T>::epsilon();
            REQUIRE(std::abs(moving_intensity(random.map(), path, begin, end, look_ups) - expected) <= slack);
            REQUIRE(std::abs(moving_intensity(with_summaries, path, begin, end, look_ups) - expected) <= slack);
            hidden += double(expected);
        }
    }
    CHECK(hidden > 0);
}

TEST_CASE_TEMPLATE("moving_intensity: a path behind the light or far away is lit", T, float, double)
{
    bit_source bits(67);
    const random_map<T> random(bits);
    for (std::int64_t n = 0; n < test::effort(2000); ++n) {
        // A path that begins over the map in front of the light and ends over the map behind the light.
        receiver_path<T> path = any_path<T>(bits);
        path.w1 = T(-1) * path.w1, path.x1 = T(-1) * path.x1, path.y1 = T(-1) * path.y1;
        const int look_ups = 1 + int(bits.below(3));
        const T reach = T(0.5) * T(look_ups), begin = path.depth.t0, end = path.depth.t1;
        const auto over = receiver_path_over(path, -reach, -reach, T(width) + reach, T(height) + reach);
        const T whole = moving_intensity(random.map(), path, begin, end, look_ups);
        const T from = begin + over.begin * (end - begin), to = begin + over.end * (end - begin);
        REQUIRE(over.end < 1);
        const T part = moving_intensity(random.map(), receiver_path_clip(path, from, to), begin, end, look_ups);
        // In perspective weights are chords, and a part of a path has cells of its own (moving_receiver_tap).
        REQUIRE(std::abs(whole - part) <= T(0.001));
        path.x0 += T(1e6) * path.w0, path.x1 += T(1e6) * path.w1;
        REQUIRE(moving_intensity(random.map(), path, begin, end, look_ups) == 0);
    }
}

TEST_CASE_TEMPLATE("sampled_intensity: with more samples it is nearer to the closed form", T, float, double)
{
    bit_source bits(63);
    double few = 0, many = 0;
    for (int n = 0; n < 200; ++n) {
        const random_map<T> random(bits);
        const receiver_path<T> path = any_path<T>(bits);
        const double exact = double(moving_intensity(random.map(), path, path.depth.t0, path.depth.t1));
        receiver_path<T> longer = path; // 16 parts of the path: 16 times as many samples
        few += std::abs(double(sampled_intensity(random.map(), path, T(0), T(1000))) - exact);
        double sum = 0;
        for (int i = 0; i < 16; ++i) {
            longer = receiver_path_clip(path, path.depth.t0 + T(i) / 16 * (path.depth.t1 - path.depth.t0),
                                        path.depth.t0 + T(i + 1) / 16 * (path.depth.t1 - path.depth.t0));
            sum += double(sampled_intensity(random.map(), longer, T(0), T(1000))) / 16;
        }
        many += std::abs(sum - exact);
    }
    CHECK(few > 0);
    CHECK(many < few / 3);
}
