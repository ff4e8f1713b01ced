// Lists of ranges: the resolved list against the front at a thousand times, the order of insertion, and full lists,
// which lose no shadow and count all that they add.
#include "list_cases.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

// The range in front is known if the next depth is farther than the slack.
TEST_CASE_TEMPLATE("a resolved list has the front at a thousand times, by depth and id, in disjoint spans", T, float,
                   double)
{
    bit_source bits(4);
    std::int64_t decided = 0, asked = 0;
    std::size_t most = 0;
    for (std::int64_t i = 0; i < effort(2'000); ++i) {
        const auto all = any_ranges<T>(1 + bits.below(8), bits);
        const auto list = list_of<32>(all), resolved = range_list_resolve(list);
        REQUIRE(list.depth_added == 0);
        REQUIRE(resolved.depth_added == 0);
        require_apart(resolved);
        const auto spans = spans_of(list);
        most = std::max(most, spans.size());
        for (int k = 0; k < 1000; ++k) {
            const double t = (k + 0.5) / 1000;
            const auto span =
                *std::find_if(spans.begin(), spans.end(), [&](const auto& s) { return t < double(s.t1); });
            const double front = front_at(all, t), seen = front_at(resolved.ranges, t);
            ++asked;
            REQUIRE((front == nowhere) == (seen == nowhere)); // times of lists are those of ranges or between them
            REQUIRE((front == nowhere) == (double(span.id) == range_nothing));
            if (front == nowhere) continue;
            const double tolerance = slack<T>(all, t);
            double next = nowhere, id = 0;
            int nearest = 0;
            for (const auto& r : all) {
                if (!(double(r.t0) <= t && t < double(r.t1))) continue;
                const double z = depth_at(r, t);
                if (z == front) id = double(r.id), ++nearest;
                else next = std::min(next, z);
            }
            REQUIRE(std::abs(seen - front) <= tolerance);
            if (next - front <= tolerance) continue;
            ++decided;
            if (nearest == 1) REQUIRE(double(span.id) == id);
        }
    }
    CHECK(double(decided) > 0.5 * double(asked));
    CHECK(most > 6);
}

TEST_CASE_TEMPLATE("while there is room, no order of insertion changes a bit of a list or of its resolved form", T,
                   float, double)
{
    bit_source bits(5);
    for (std::int64_t i = 0; i < effort(300); ++i) {
        auto few = any_ranges<T>(5, bits);
        const auto first = range_list_resolve(list_of<8>(few));
        std::array<std::size_t, 5> order{0, 1, 2, 3, 4};
        do {
            ranges<T> permuted;
            for (const std::size_t k : order) permuted.push_back(few[k]);
            REQUIRE(equal(range_list_resolve(list_of<8>(permuted)), first));
        } while (std::next_permutation(order.begin(), order.end()));
    }
    for (std::int64_t i = 0; i < effort(3'000); ++i) {
        auto many = any_ranges<T>(16, bits);
        many[15] = many[3];
        const auto first = list_of<16>(many);
        for (std::size_t k = many.size(); k > 1; --k) std::swap(many[k - 1], many[bits.below(k)]);
        REQUIRE(equal(range_list_resolve(list_of<16>(many)), range_list_resolve(first)));
        REQUIRE(spans_of(list_of<16>(many)).size() == spans_of(first).size());
    }
}

// For any number of ranges in any order, no receiver behind one of them is lit, at any time. For the depth lines of a
// list that is strict; range_depth is 10 2^-p off, and the receiver has a rounding of its own. Both costs are bounds.
TEST_CASE_TEMPLATE("full lists lose no shadow, and count the shadow that they add", T, float, double)
{
    bit_source bits(6);
    std::array<int, 3> full{};
    const auto check = [&]<int capacity>(int& overflows) {
        auto all = any_ranges<T>(1 + bits.below(40), bits);
        if (bits.chance(0.5)) // brief ones, of which few hide one another
            for (auto& r : all) r.t1 = r.t0 + (r.t1 - r.t0) / 8;
        const auto list = list_of<capacity>(all), resolved = range_list_resolve(list);
        require_apart(resolved);
        spans_of(list);
        overflows += list.depth_added > 0;
        double added = 0;
        constexpr int times = 500;
        for (int k = 0; k < times; ++k) {
            const T t = T((k + 0.5) / times);
            const double front = front_at(all, double(t)), seen = front_at(resolved.ranges, double(t));
            if (front != nowhere) {
                REQUIRE(front_at(list.ranges, double(t)) <= front + 0x1p-52); // rounded once each, here
                const T behind = T(front + 20 * u<T>), farther = T(front + slack<T>(list.ranges, double(t)));
                REQUIRE(range_list_intensity(list, t, behind, T(9), T(0)) == 1);
                REQUIRE(range_list_intensity(resolved, t, farther, T(9), T(0)) == 1);
            }
            if (seen != nowhere && front - seen > double(resolved.depth_added) + 64 * capacity * u<T>)
                added += 1.0 / times;
        }
        // Each of up to capacity intervals of added time is off by one of the times.
        REQUIRE(added <= double(resolved.time_added) + double(capacity) / times);
    };
    for (std::int64_t i = 0; i < effort(1'000); ++i) {
        check.template operator()<4>(full[0]);
        check.template operator()<8>(full[1]);
        check.template operator()<16>(full[2]);
    }
    for (const int overflows : full) CHECK(overflows > 0);
}

TEST_CASE_TEMPLATE("ranges of one id are merged first; a range of several ids shadows every receiver", T, float, double)
{
    range_list<T, 2> list = range_list_make<T, 2>({T(0), T(0.25), T(-0.5), T(-0.5), T(1)});
    list = range_list_insert(list, {T(0.25), T(0.5), T(-0.5), T(-0.5), T(2)});
    list = range_list_insert(list, {T(0.5), T(0.75), T(-0.5), T(-0.5), T(2)});
    CHECK(list.ranges[0].id == T(1));
    CHECK(list.ranges[1].id == T(2));
    CHECK(list.ranges[1].t1 == T(0.75));
    CHECK(list.time_added == 0);
    list = range_list_insert(list, {T(0.875), T(1), T(0.5), T(0.5), T(3)});
    const bool first = double(list.ranges[0].id) == range_mixed;
    CHECK(first != (double(list.ranges[1].id) == range_mixed));
    const T t = list.ranges[first ? 0 : 1].t0;
    for (const int id : {1, 2, 3}) CHECK(range_list_intensity(list, t, T(0.9), T(id), T(0)) == 1);
}

// The closed form of a resolved list, against the front at many times.
TEST_CASE_TEMPLATE("a static receiver under a resolved list loses the light that many times say", T, float, double)
{
    bit_source bits(7);
    constexpr int times = 20'000;
    for (std::int64_t i = 0; i < effort(100); ++i) {
        const auto all = any_ranges<T>(6, bits);
        const auto resolved = range_list_resolve(list_of<16>(all));
        const T z = T(bits.uniform(-1, 1));
        const static_receiver<T> receiver = static_receiver_begin(z, T(9), T(0), T(1));
        double box = 0, tent = 0;
        for (int k = 0; k < times; ++k) {
            const double t = (k + 0.5) / times;
            if (!(front_at(all, t) < double(z))) continue;
            box += 1.0 / times;
            tent += (t < 0.5 ? 4 * t : 4 - 4 * t) / times;
        }
        // Up to 2 changes for each of 16 ranges, each off by half a time; level ranges at exactly the receiver's depth
        // do not occur.
        static_receiver<T> by_box = receiver, by_tent = receiver;
        for (const auto& range : resolved.ranges) {
            by_box = add_range(by_box, range, box_shutter{});
            by_tent = add_range(by_tent, range, tent_shutter{});
        }
        CHECK(std::abs(double(static_receiver_end(by_box)) - box) <= 16.0 / times + 1e-4);
        CHECK(std::abs(double(static_receiver_end(by_tent)) - tent) <= 32.0 / times + 2e-4);
    }
}

TEST_CASE_TEMPLATE("hostile ranges and lists stay finite, in order, and end", T, float, double)
{
    bit_source bits(8);
    hostile_source<T> hostile(9);
    const auto any = [&] {
        return bits.chance(0.3) ? T(bits.uniform(-1, 2)) : bits.chance(0.5) ? hostile.special() : hostile.pattern();
    };
    const auto one = [&] { return range<T>{any(), any(), any(), any(), any()}; };
    for (std::int64_t i = 0; i < effort(50'000); ++i) {
        range_list<T, 4> list = range_list_make<T, 4>(one());
        if (bits.chance(0.5)) list = {{one(), one(), one(), one()}, any(), any()};
        spans_of(list);
        for (int k = 0; k < 6; ++k) list = range_list_insert(list, bits.chance(0.1) ? list.ranges[0] : one());
        const range_list<T, 4> resolved = range_list_resolve(list);
        require_apart(resolved);
        for (const auto& some : {list, resolved})
            for (const auto& r : some.ranges) {
                REQUIRE(std::isfinite(r.t0 + r.t1));
                REQUIRE(std::isfinite(r.z0));
                REQUIRE(std::isfinite(r.z1));
                REQUIRE(!std::isnan(r.id));
            }
        REQUIRE((list.time_added >= 0 && list.time_added <= 1));
        REQUIRE(list.depth_added >= 0);
    }
    const T nan = std::numeric_limits<T>::quiet_NaN();
    CHECK(!lasts(range_list_front(range_list_make<T, 4>({T(0), nan, T(0), T(0), T(1)}), T(1))));
    const auto same = range<T>{T(0.25), T(0.5), T(0), T(0), T(1)};
    CHECK(list_of<4>(ranges<T>(40, same)).depth_added == 0); // all the same: one of them is kept
    CHECK(list_of<4>(ranges<T>(40, {T(0.5), T(0.5), T(0), T(0), T(1)})).depth_added == 0);
    CHECK(spans_of(list_of<4>(ranges<T>(40, same))).size() == 3);
}
