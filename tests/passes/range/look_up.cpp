// Look-ups in maps of ranges: closed forms against many times, wide filters against the mean of narrow ones, and what
// is outside of the map.
#include "support/effort.hpp"
#include "support/hostile.hpp"

#include <gnomon/passes/range/look_up.hpp>
#include <gnomon/passes/range/resolve.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

using namespace gnomon;
using gnomon::test::bit_source;

namespace {

constexpr std::size_t width = 12, height = 10;

/// Random resolved lists in every texel.
template <class T> struct random_map {
    std::vector<std::uint32_t> first;
    std::vector<depth_time_range<T>> ranges;

    explicit random_map(bit_source& bits) : first(range_map<T>::texels(width, height) + 1)
    {
        std::vector<std::uint32_t> texels;
        std::vector<depth_time_range<T>> all;
        for (std::size_t i = 0; i < width * height; ++i) {
            std::vector<depth_time_range<T>> list(bits.below(6));
            for (auto& r : list) {
                const double a = bits.uniform(0, 1), b = bits.uniform(0, 1);
                r = range_between(T(a), T(bits.uniform(-1, 1)), T(b), T(bits.uniform(-1, 1)), T(bits.below(5)));
            }
            std::vector<visible_span<T>> room(resolve_capacity(list.size(), range_ids::any));
            for (const auto& s : resolve_ranges<T>(list, room, range_ids::any)) {
                texels.push_back(std::uint32_t(range_map<T>::texel(width, i % width, i / width)));
                all.push_back(range_of<T>(list, s));
            }
        }
        ranges.resize(all.size());
        sort_into_lists<T>(texels, all, first, ranges);
    }
    range_map<T> map() const { return {width, height, first, ranges}; }

    /// The map with totals, which totals hold.
    range_map<T> with_totals(std::vector<range_summary<T>>& totals) const
    {
        totals.resize(first.size() - 1);
        range_map<T> result = map();
        set_summaries(result, std::span(totals), range_ids::any);
        result.summaries = totals;
        return result;
    }

    /// Has most lists of one range hide at all times, behind which no list is read.
    void fill(bit_source& bits)
    {
        for (std::size_t i = 0; i + 1 < first.size(); ++i)
            if (first[i + 1] == first[i] + 1 && bits.chance(0.9)) ranges[first[i]].t0 = 0, ranges[first[i]].t1 = 1;
    }
};

/// Over the map, some of them past its border.
template <class T> receiver_path<T> any_path(bit_source& bits)
{
    const double reach = bits.chance(0.3)   ? 0.7
                         : bits.chance(0.5) ? 4
                                            : 40,
                 x = bits.uniform(2, 10), y = bits.uniform(2, 8);
    const double a = bits.uniform(0, 0.4), b = bits.uniform(0.6, 1);
    return {{T(a), T(b), T(bits.uniform(-1, 1)), T(bits.uniform(-1, 1)), T(2)},
            T(x),
            T(y),
            T(1),
            T(x + bits.uniform(-reach, reach)),
            T(y + bits.uniform(-reach, reach)),
            T(1)};
}

} // namespace

TEST_CASE_TEMPLATE("moving_intensity: what many times say", T, float, double)
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
        // Between times at which a range comes, goes or is met, of which some hundred are in reach, each of a weight of
        // at most 1 / K^2, weights are polynomials: a sample in the middle is right to the square of its share.
        CHECK(std::abs(found - sum / times) <= 300.0 / times / (look_ups * look_ups) + 1e-4);
        errors += std::abs(found - sum / times);
    }
    // Each is off by any part of half a time either way, so three hundred of them by the root of their number.
    CHECK(errors / double(cases) <= std::sqrt(300.0 / 12) / times + 1e-4);
}

TEST_CASE_TEMPLATE("moving_intensity: the fold of its kernels, with totals and without", T, float, double)
{
    bit_source bits(68);
    const auto fold = [](const moving_receiver<T>& s, const depth_time_range<T>& r) {
        return moving_receiver_filter_box(s, r);
    };
    double hidden = 0;
    for (std::int64_t n = 0; n < test::effort(300); ++n) {
        random_map<T> random(bits);
        random.fill(bits);
        std::vector<range_summary<T>> totals;
        const range_map<T> with_totals = random.with_totals(totals);
        for (int k = 0; k < 20; ++k) {
            receiver_path<T> path = any_path<T>(bits);
            const T behind = T(bits.below(3));
            path.depth.z0 += behind, path.depth.z1 += behind, path.depth.id = T(bits.below(6));
            const int look_ups = 1 + int(bits.below(3));
            T begin = bits.chance(0.5) ? path.depth.t0 : T(bits.uniform(-0.2, 0.4)), end = T(bits.uniform(0.5, 1.2));
            if (bits.chance(0.2)) std::swap(begin, end);
            const T expected = moving_intensity(random.map(), path, begin, end, look_ups, fold);
            // Each of some hundred spans has an error of some hundred roundings times its share of the time; those that
            // run almost at the receiver's depth cross it at times that roundings move.
            const T slack = T(1e4) * std::numeric_limits<T>::epsilon();
            REQUIRE(std::abs(moving_intensity(random.map(), path, begin, end, look_ups) - expected) <= slack);
            REQUIRE(std::abs(moving_intensity(with_totals, path, begin, end, look_ups) - expected) <= slack);
            hidden += double(expected);
        }
    }
    CHECK(hidden > 0);
}

TEST_CASE_TEMPLATE("moving_intensity: what the light does not see is lit, behind its plane and far away", T, float,
                   double)
{
    bit_source bits(67);
    const random_map<T> random(bits);
    for (std::int64_t n = 0; n < test::effort(2000); ++n) {
        // On the map before the light, on the map again behind it.
        receiver_path<T> path = any_path<T>(bits);
        path.w1 = T(-1) * path.w1, path.x1 = T(-1) * path.x1, path.y1 = T(-1) * path.y1;
        const int look_ups = 1 + int(bits.below(3));
        const T reach = T(0.5) * T(look_ups), begin = path.depth.t0, end = path.depth.t1;
        const auto over = receiver_path_over(path, -reach, -reach, T(width) + reach, T(height) + reach);
        const T whole = moving_intensity(random.map(), path, begin, end, look_ups);
        const T from = begin + over.begin * (end - begin), to = begin + over.end * (end - begin);
        REQUIRE(over.end < 1);
        const T part = moving_intensity(random.map(), receiver_path_clip(path, from, to), begin, end, look_ups);
        // Weights are chords in perspective, and a part of the path has its own cells: see moving_receiver_tap.
        REQUIRE(std::abs(whole - part) <= T(0.001));
        path.x0 += T(1e6) * path.w0, path.x1 += T(1e6) * path.w1;
        REQUIRE(moving_intensity(random.map(), path, begin, end, look_ups) == 0);
    }
}

TEST_CASE_TEMPLATE("static_intensity is moving_intensity at rest; a wide filter is the mean of narrow ones", T, float,
                   double)
{
    bit_source bits(62);
    const double u = double(std::numeric_limits<T>::epsilon());
    for (std::int64_t n = 0; n < test::effort(500); ++n) {
        const random_map<T> random(bits);
        receiver_path<T> path = any_path<T>(bits);
        path.x1 = path.x0, path.y1 = path.y0, path.depth.z1 = path.depth.z0;
        const auto at_rest = [&](T x, T y, int look_ups) {
            const auto state = static_receiver_begin(path.depth.z0, path.depth.id, path.depth.t0, path.depth.t1);
            return double(static_intensity(random.map(), x, y, state, look_ups));
        };
        const double one = at_rest(path.x0, path.y0, 1);
        // Ranges that run almost at the receiver's depth cross it at times that roundings move.
        const double slack = 1e4 * u;
        CHECK(std::abs(double(moving_intensity(random.map(), path, path.depth.t0, path.depth.t1)) - one) <= slack);
        double mean = 0;
        for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i) mean += at_rest(path.x0 + T(i), path.y0 + T(j), 1) / 9;
        CHECK(std::abs(at_rest(path.x0, path.y0, 3) - mean) <= slack);
    }
}

TEST_CASE_TEMPLATE("sampled_intensity: more samples are nearer to the closed form", T, float, double)
{
    bit_source bits(63);
    double few = 0, many = 0;
    for (int n = 0; n < 200; ++n) {
        const random_map<T> random(bits);
        const receiver_path<T> path = any_path<T>(bits);
        const double exact = double(moving_intensity(random.map(), path, path.depth.t0, path.depth.t1));
        receiver_path<T> longer = path; // the same way at a sixteenth of the pace: 16 times as many samples
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

TEST_CASE_TEMPLATE("static_intensities: the bits of static_intensity, however long lists are", T, float, double)
{
    bit_source bits(64);
    for (std::int64_t n = 0; n < test::effort(200); ++n) {
        const random_map<T> random(bits);
        const int look_ups = 1 + int(bits.below(8)); // 81 lists are more than the queue holds
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

TEST_CASE_TEMPLATE("totals change nothing but roundings, one by one and many at a time", T, float, double)
{
    bit_source bits(66);
    std::int64_t behind = 0, before = 0;
    for (std::int64_t n = 0; n < test::effort(200); ++n) {
        random_map<T> random(bits);
        random.fill(bits);
        std::vector<range_summary<T>> totals;
        const range_map<T> with_totals = random.with_totals(totals);
        const int look_ups = 1 + int(bits.below(3));
        std::vector<placed_receiver<T>> receivers(bits.below(100));
        for (auto& r : receivers) {
            const T begin = bits.chance(0.5) ? T(0.25) : T(0); // most totals are of the whole shutter
            r = {T(bits.uniform(-2, 14)), T(bits.uniform(-2, 12)),
                 static_receiver_begin(T(bits.uniform(-1, 1.5)), T(9), begin, T(1))};
        }
        std::vector<T> found(receivers.size());
        static_intensities<T>(with_totals, receivers, found, look_ups);
        // 16 texels of at most 6 ranges, or rather what of them is in front when, 4 roundings each.
        const T slack = T(16 * 11 * 4) * std::numeric_limits<T>::epsilon();
        for (std::size_t i = 0; i < found.size(); ++i) {
            const auto& [x, y, state] = receivers[i];
            const T expected = static_intensity(random.map(), x, y, state, look_ups);
            REQUIRE(std::abs(static_intensity(with_totals, x, y, state, look_ups) - expected) <= slack);
            REQUIRE(std::abs(found[i] - expected) <= slack);
            (state.depth > 1 ? behind : before) += expected > 0;
        }
    }
    CHECK(behind > 0);
    CHECK(before > 0);
}

#if defined(__cpp_exceptions)
TEST_CASE("static_intensities say what does not fit")
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
    std::vector<range_summary<float>> totals(map.first.size()), few(3);
    map.summaries = totals;
    CHECK_THROWS_WITH_AS(static_intensities<float>(map, receivers, shadows),
                         doctest::Contains("static_intensities: map.summaries.size() + 1 is"), std::invalid_argument);
    CHECK_THROWS_WITH_AS(set_summaries(random.map(), std::span(few), range_ids::any),
                         doctest::Contains("range summaries: summaries.size() + 1 is 4"), std::invalid_argument);
    CHECK(shadows == std::vector<float>(2, 7.f));
}
#endif

TEST_CASE_TEMPLATE("outside of the map, and nowhere, it is lit; a shutter of one's own", T, float, double)
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
    const auto tent = [](const static_receiver<T>& s, const depth_time_range<T>& r) {
        return static_receiver_add_tent(s, r);
    };
    CHECK(static_intensity(map, T(6), T(5), static_receiver_begin(T(0), T(2), T(0.25), T(1)), 1, tent) ==
          doctest::Approx(2.0 / 9));
    const receiver_path<T> lost{{T(0), T(1), T(0), T(0), T(2)}, nan, T(5), T(1), T(6), T(5), T(1)};
    CHECK(moving_intensity(map, lost, T(0), T(1)) == 0);
    CHECK(intensity_at(map, lost, T(0.25), T(0)) == 0);
    const T sampled = sampled_intensity(map, lost, T(0), T(64));
    CHECK((sampled >= 0 && sampled <= 1));
}
