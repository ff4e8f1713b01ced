// Static receivers under resolved lists of depth-time ranges: the closed form against a hundred thousand times, and
// changes of a list that change no result.
#include "receiver_cases.hpp"
#include "support/effort.hpp"

#include <doctest/doctest.h>

using namespace gnomon;
using namespace gnomon::test;

namespace {

template <class T> T intensity(const std::vector<depth_time_range<T>>& list, T z, T id, const test_shutter<T>& shutter)
{
    static_receiver<T> state = static_receiver_begin(z, id, shutter.begin, shutter.end);
    for (const auto& r : list) state = shutter.add(state, r);
    return static_receiver_end(state);
}

} // namespace

TEST_CASE_TEMPLATE("static receiver: within the stated error", T, float, double)
{
    bit_source bits(13);
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        const auto list = resolved_list<T>(bits);
        const T z = T(bits.uniform(-1, 1)), begin = T(bits.uniform(0, 0.5)), end = T(bits.uniform(0.5, 1));
        const auto shutter = any_shutter(responses[std::size_t(i) % responses.size()], begin, end, bits);
        if (!(begin < end)) continue;
        loss all{0, 0};
        for (const auto& r : list) {
            const loss one = exact_loss(r, depth_time_range<T>{begin, end, z, z, T(9)}, begin, end, shutter);
            all = {all.share + one.share, all.error + one.error};
        }
        REQUIRE(std::abs(wide(intensity(list, z, T(9), shutter)) - all.share) <= all.error);
    }
}

TEST_CASE_TEMPLATE("static receiver: the closed form is the mean over a hundred thousand times", T, float, double)
{
    constexpr int times = 100'000;
    bit_source bits(11);
    for (std::int64_t i = 0; i < effort(200); ++i) {
        const auto list = resolved_list<T>(bits);
        const T z = T(bits.uniform(-1, 1)), id = T(bits.below(3));
        const T a = T(bits.uniform(0, 1)), b = T(bits.uniform(0, 1));
        const T begin = i % 2 ? T(0) : std::min(a, b), end = i % 2 ? T(1) : std::max(a, b);
        if (double(end) - double(begin) < 0.01) continue;
        std::array<test_shutter<T>, responses.size()> shutters;
        for (std::size_t k = 0; k < shutters.size(); ++k) shutters[k] = any_shutter(responses[k], begin, end, bits);
        std::array<wide, responses.size()> sums{};
        for (int k = 0; k < times; ++k) {
            const wide x = (k + 0.5L) / times, t = wide(begin) + x * (wide(end) - wide(begin));
            const auto hides = [&](const depth_time_range<T>& r) {
                return wide(r.t0) <= t && t < wide(r.t1) && exact_depth(r, t) < wide(z) && r.id != id;
            };
            if (std::any_of(list.begin(), list.end(), hides))
                for (std::size_t j = 0; j < responses.size(); ++j) sums[j] += shutters[j].density(x) / times;
        }
        // Each of up to 7 ranges begins and ends within one of the times.
        for (std::size_t j = 0; j < responses.size(); ++j)
            CHECK(std::abs(wide(intensity(list, z, id, shutters[j])) - sums[j]) <=
                  shutters[j].largest() * (14.0L / times + 1e-5L));
    }
}

TEST_CASE_TEMPLATE("static receiver: the order of ranges and cuts in them change only roundings", T, float, double)
{
    bit_source bits(12);
    for (int i = 0; i < 2000; ++i) {
        auto list = resolved_list<T>(bits);
        const T z = T(bits.uniform(-1, 1));
        const auto shutter = any_shutter(i % 2 == 1 ? response::tent : response::box, T(0), T(1), bits);
        const double first = double(intensity(list, z, T(9), shutter));
        std::reverse(list.begin(), list.end());
        const T cut = T(bits.uniform(0, 1));
        const auto whole = list;
        for (auto& r : list) r = range_clip(r, T(0), cut);
        for (const auto& r : whole) list.push_back(range_clip(r, cut, T(1)));
        const double again = double(intensity(list, z, T(9), shutter));
        // A cut moves the depth line by 5 roundings of it, and the crossing by as much over the slope. Where the depth
        // hardly changes, that may be any time: such cases are skipped.
        const bool level = std::any_of(whole.begin(), whole.end(),
                                       [](const auto& r) { return std::abs(double(r.z1) - double(r.z0)) < 0.01; });
        if (!level) CHECK(std::abs(first - again) <= 7 * 2e4 * double(std::numeric_limits<T>::epsilon()));
    }
}

TEST_CASE_TEMPLATE("static receiver: nothing, everything, its own surface, half, one depth, NaN", T, float, double)
{
    const T nan = std::numeric_limits<T>::quiet_NaN();
    const depth_time_range<T> all{T(0), T(1), T(-0.5), T(0.5), T(1)};
    bit_source bits(14);
    for (const response kind : responses) {
        test_shutter<T> s = any_shutter(kind, T(0), T(1), bits);
        s.weights = {T(0.25), T(0.25), T(0), T(0), T(0), T(0), T(0.5), T(0)};
        CHECK(intensity<T>({}, T(0), T(2), s) == 0);
        CHECK(intensity<T>({all}, T(0.75), T(2), s) == 1);
        CHECK(intensity<T>({all}, T(-0.75), T(2), s) == 0);
        CHECK(intensity<T>({all}, T(0.75), T(1), s) == 0);
        CHECK(intensity<T>({all}, T(0), T(2), s) == T(0.5));
        CHECK(intensity<T>({all}, nan, T(2), s) == 0);
        CHECK(intensity<T>({{T(0), nan, T(-1), T(-1), T(1)}}, T(0.75), T(2), s) == 0);
        s.begin = nan;
        CHECK(intensity<T>({all}, T(0.75), T(2), s) == 0);
        // Half of a static ground does not shadow the other half, for any exposure.
        for (int i = 0; i < 1000; ++i) {
            const T z = T(bits.uniform(-1, 1));
            s.begin = T(bits.uniform(0, 0.5)), s.end = T(bits.uniform(0.5, 1));
            CHECK(intensity<T>({{T(bits.uniform(0, 0.6)), T(bits.uniform(0.6, 1)), z, z, T(1)}}, z, T(2), s) == 0);
        }
    }
}

TEST_CASE_TEMPLATE("range_summary: the light that a receiver behind a list loses, within the stated error", T, float,
                   double)
{
    constexpr T nan = std::numeric_limits<T>::quiet_NaN();
    bit_source bits(16);
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        auto list = resolved_list<T>(bits);
        range_summary<T> total = range_summary_begin(T(-1));
        for (const auto& r : list) total = range_summary_add(total, r);
        // Ranges that no receiver sees.
        for (const auto& r : {depth_time_range<T>{T(0), T(1), nan, T(2), T(1)},
                              {T(1), T(0), T(2), T(2), T(1)},
                              {nan, T(1), T(2), T(2), T(1)}})
            total = range_summary_add(total, r);
        T nearest = T(2), farthest = T(-1), id = T(range_nothing);
        for (const auto& r : list)
            if (r.t0 < r.t1) {
                nearest = std::min({nearest, r.z0, r.z1}), farthest = std::max({farthest, r.z0, r.z1});
                id = id == T(range_nothing) || id == r.id ? r.id : T(range_mixed);
            }
        REQUIRE(total.farthest == farthest);
        REQUIRE(total.id == id);
        REQUIRE(receiver_is_in_front(nearest, total) == 1);
        REQUIRE(receiver_is_in_front(std::nextafter(nearest, T(9)), total) == (nearest == 2));
        REQUIRE(receiver_is_in_front(nan, total) == 0);

        const T weight = T(bits.uniform(0, 1));
        const auto at = [&](T z, T begin, T end) {
            return static_receiver_set_weight(static_receiver_begin(z, T(9), begin, end), weight);
        };
        REQUIRE(static_receiver_is_behind(at(farthest, T(0), T(1)), total) == 0);
        REQUIRE(static_receiver_is_behind(at(T(2), T(0.5), T(1)), total) == 0);
        REQUIRE(static_receiver_is_behind(at(T(2), T(0), T(0.5)), total) == 0);
        REQUIRE(static_receiver_is_behind(at(nan, T(0), T(1)), total) == 0);
        static_receiver<T> one_by_one = at(T(2), T(0), T(1)), at_once = one_by_one;
        // With several ids, or the receiver's own, the ranges in front are unknown.
        const auto seen_by = [&](T own) { return static_receiver_begin(T(2), own, T(0), T(1)); };
        REQUIRE(static_receiver_is_behind(at_once, total) == (id == T(range_mixed) ? 0 : 1));
        REQUIRE(static_receiver_is_behind(seen_by(id), total) == 0);
        total.id = T(range_nothing);
        REQUIRE(static_receiver_is_behind(seen_by(id), total) == (id == T(range_nothing) ? 0 : 1));
        REQUIRE(static_receiver_is_behind(at_once, total) == 1);
        at_once = static_receiver_add(at_once, total.shadowed);
        wide expected = 0;
        for (const auto& r : list) expected += wide(weight) * std::max(wide(r.t1) - wide(r.t0), wide(0));
        for (const auto& r : list) one_by_one = add_range(one_by_one, r, box_shutter{});
        const wide error = wide(list.size()) * 2 * wide(std::numeric_limits<T>::epsilon());
        REQUIRE(std::abs(wide(at_once.shadowed) - expected) <= error);
        REQUIRE(std::abs(wide(one_by_one.shadowed) - expected) <= 9 * error);
    }
}

TEST_CASE_TEMPLATE("static receiver: with filtering, the weighted mean of its texels", T, float, double)
{
    bit_source bits(15);
    for (std::int64_t i = 0; i < effort(20'000); ++i) {
        const auto s = any_shutter(responses[std::size_t(i) % responses.size()], T(0), T(1), bits);
        const T z = T(bits.uniform(-1, 1)), u = T(bits.uniform(0, 1)), v = T(bits.uniform(0, 1));
        const std::size_t look_ups = 1 + bits.below(3);
        static_receiver<T> state = static_receiver_begin(z, T(9), s.begin, s.end);
        wide expected = 0, weights = 0;
        for (std::size_t k = 0; k < (look_ups + 1) * (look_ups + 1); ++k) {
            const std::size_t x = k % (look_ups + 1), y = k / (look_ups + 1);
            const auto list = resolved_list<T>(bits);
            // The mean of look-ups by definition: each weights texel x with its u, and texel x - 1 with the rest.
            const auto by_definition = [&](std::size_t n, wide share) {
                return ((n < look_ups ? 1 - share : 0) + (n > 0 ? share : 0)) / wide(look_ups);
            };
            const wide weight = by_definition(x, wide(u)) * by_definition(y, wide(v));
            weights += weight;
            expected += weight * wide(intensity(list, z, T(9), s));
            state = static_receiver_set_weight(state,
                                               texel_weight(u, T(x), T(look_ups)) * texel_weight(v, T(y), T(look_ups)));
            for (const auto& r : list) state = s.add(state, r);
        }
        REQUIRE(std::abs(weights - 1) < 1e-15L);
        // Each weight has 5 roundings, each of up to 7 ranges one more for its product and one for the sum so far.
        REQUIRE(std::abs(wide(static_receiver_end(state)) - expected) <= (5 + 7 * 16 + 7) * rounding<T>);
    }
}
