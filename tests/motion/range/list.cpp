// Lists of depth-time ranges: what ranges do to one another, a list's resolve against the front-most of thousands of
// times, the order of insertion, and full lists, in which nothing may leave the shadow and every cost is on the bill.
#include "support/effort.hpp"
#include "support/hostile.hpp"

#include <gnomon/motion/range/range_list.h>
#include <gnomon/passes/range/shutters.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

template <class T> using range = depth_time_range<T>;
template <class T> using ranges = std::vector<range<T>>;
template <class T> constexpr double u = double(std::numeric_limits<T>::epsilon()) / 2;

/// Times and depths of a lattice half of the time, so that ends and depths meet.
template <class T> range<T> any_range(bit_source& bits)
{
    const bool lattice = bits.chance(0.5);
    const auto time = [&] { return T(lattice ? double(bits.below(9)) / 8 : bits.uniform(0, 1)); };
    const auto depth = [&] { return T(lattice ? double(bits.below(9)) / 4 - 1 : bits.uniform(-1, 1)); };
    const T z = depth();
    return range_between(time(), z, time(), bits.chance(0.3) ? z : depth(), T(bits.below(4)));
}

template <class T> ranges<T> any_ranges(std::size_t count, bit_source& bits)
{
    ranges<T> result(count);
    for (auto& r : result) r = any_range<T>(bits);
    return result;
}

template <int capacity, class T> range_list<T, capacity> list_of(const ranges<T>& all)
{
    range_list<T, capacity> list = range_list_make<T, capacity>({});
    for (const auto& r : all) list = range_list_insert(list, r);
    return list;
}

bool lasts(const auto& r) { return r.t0 < r.t1; }

template <class T> bool equal(const range<T>& a, const range<T>& b)
{
    return a.t0 == b.t0 && a.t1 == b.t1 && a.z0 == b.z0 && a.z1 == b.z1 && a.id == b.id;
}

template <class T, int capacity> bool equal(const range_list<T, capacity>& a, const range_list<T, capacity>& b)
{
    return std::equal(std::begin(a.ranges), std::end(a.ranges), std::begin(b.ranges),
                      [](const auto& x, const auto& y) { return equal(x, y); });
}

/// Depth without rounding, near enough: in extended precision.
template <class T> double depth_at(const range<T>& r, double t)
{
    using wide = long double;
    const wide passed = (wide(t) - wide(r.t0)) / (wide(r.t1) - wide(r.t0));
    return double(wide(r.z0) + passed * (wide(r.z1) - wide(r.z0)));
}

constexpr double nowhere = 9;

/// The depth that the light sees, or nowhere.
double front_at(const auto& all, double t)
{
    double z = nowhere;
    for (const auto& r : all)
        if (double(r.t0) <= t && t < double(r.t1)) z = std::min(z, depth_at(r, t));
    return z;
}

/// How far behind the front a resolve may be at time t. It has other depths than the ranges by 10 2^-p in range_depth
/// and as much when cut; and it is late in changing from one to the other by the error of a crossing: 40 roundings of
/// depths, and 4 of times, for which a line of a short range covers much depth. Where rounding has each of several in
/// front of the next, the last is that much behind each of the others.
template <class T> double slack(const auto& all, double t)
{
    double steepest = 0, others = -1;
    for (const auto& r : all) {
        if (!(double(r.t0) <= t && t <= double(r.t1) && lasts(r))) continue;
        steepest = std::max(steepest, 2 / (double(r.t1) - double(r.t0)));
        ++others;
    }
    return std::max(1.0, others) * u<T> * (64 + 8 * steepest);
}

template <class T, int capacity> ranges<T> spans_of(const range_list<T, capacity>& list)
{
    ranges<T> spans;
    for (T t = T(0); t < T(1);) {
        spans.push_back(range_list_front(list, t));
        REQUIRE(spans.back().t0 == t);
        REQUIRE(spans.back().t1 > t);
        REQUIRE(spans.back().t1 <= T(1));
        REQUIRE(std::isfinite(spans.back().z0));
        REQUIRE(std::isfinite(spans.back().z1));
        t = spans.back().t1;
    }
    REQUIRE(spans.size() <= std::size_t((capacity + 1) * (capacity + 2) / 2));
    return spans;
}

/// Ranges in order of time and apart, empty ones first.
void require_apart(const auto& list)
{
    double end = 0;
    for (const auto& r : list.ranges) {
        if (!lasts(r)) REQUIRE(end == 0);
        if (!lasts(r)) continue;
        REQUIRE(double(r.t0) >= end);
        end = double(r.t1);
    }
    REQUIRE(end <= 1);
}

} // namespace

TEST_CASE_TEMPLATE("range_less: one order of two, of three, of everything", T, float, double)
{
    bit_source bits(1);
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        const auto a = any_range<T>(bits), b = bits.chance(0.1) ? a : any_range<T>(bits), c = any_range<T>(bits);
        REQUIRE(int(range_less(a, b)) + int(range_less(b, a)) + int(equal(a, b)) == 1);
        if (range_less(a, b) && range_less(b, c)) REQUIRE(range_less(a, c));
        if (range_occludes(a, b) && range_occludes(b, c)) REQUIRE(range_occludes(a, c));
        if (range_occludes(a, b) && range_occludes(b, a)) REQUIRE(equal(a, b));
    }
}

TEST_CASE_TEMPLATE("range_visible_part, range_trim: both fill the common time, the nearer one is in front", T, float,
                   double)
{
    bit_source bits(2);
    std::array<int, 3> cut{};
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        const auto a = any_range<T>(bits), b = any_range<T>(bits);
        const auto over = range_visible_part(a, b), under = range_visible_part(b, a), common = range_clip_to(a, b);
        if (lasts(common) && a.id != b.id) {
            REQUIRE((lasts(over) || lasts(under)));
            const T first = lasts(over) ? over.t0 : T(2), second = lasts(under) ? under.t0 : T(2);
            REQUIRE(std::min(first, second) == common.t0);
            REQUIRE(std::max(lasts(over) ? over.t1 : T(0), lasts(under) ? under.t1 : T(0)) == common.t1);
            if (lasts(over) && lasts(under)) REQUIRE((over.t1 == under.t0 || under.t1 == over.t0));
        }
        const auto left = range_trim(a, b);
        ++cut[lasts(left) ? left.t0 == a.t0 && left.t1 == a.t1 ? 0 : 1 : 2];
        for (int k = 0; lasts(a) && k < 32; ++k) {
            const double t = (k + 0.5) / 32;
            const auto during = [&](const auto& r) { return double(r.t0) <= t && t < double(r.t1); };
            if (!during(a)) continue;
            if (!during(left)) REQUIRE(during(b)); // no time is without either
            if (during(left)) REQUIRE(std::abs(depth_at(left, t) - depth_at(a, t)) <= 20 * u<T>);
            if (!during(b)) continue;
            const double behind = depth_at(a, t) - depth_at(b, t), steep = slack<T>(ranges<T>{a, b}, t);
            if (std::abs(behind) <= steep) continue;
            REQUIRE(during(over) == (behind < 0));
            REQUIRE(during(under) == (behind > 0));
            if (!during(left)) REQUIRE(behind > 0);
        }
    }
    for (const int count : cut) CHECK(count > 0);
}

// In front of both by what range_depth says, and not just nearly so: the margin outweighs all rounding.
TEST_CASE_TEMPLATE("range_merge: all of both times, in front of both; its costs", T, float, double)
{
    bit_source bits(3);
    for (std::int64_t i = 0; i < effort(50'000); ++i) {
        const auto a = any_range<T>(bits), b = any_range<T>(bits);
        const auto pair = range_pair_make(a, b), other = range_pair_make(b, a);
        if (!lasts(a) || !lasts(b)) {
            REQUIRE(pair.cost == T(-1));
            REQUIRE(equal(pair.merged, lasts(a) ? a : b));
            continue;
        }
        const auto m = range_merge(a, b);
        REQUIRE(equal(m, pair.merged));
        REQUIRE(equal(m, other.merged));
        REQUIRE(m.t0 == std::min(a.t0, b.t0));
        REQUIRE(m.t1 == std::max(a.t1, b.t1));
        REQUIRE(double(m.id) == (a.id == b.id ? double(a.id) : range_mixed));
        double area = 0, shift = 0, gap = 0;
        constexpr int times = 64;
        const double step = (double(m.t1) - double(m.t0)) / times;
        for (int k = 0; k < times; ++k) {
            const T t = T(double(m.t0) + (k + 0.5) * step);
            for (const auto& r : {a, b})
                if (r.t0 <= t && t <= r.t1) REQUIRE(range_depth(m, t) <= range_depth(r, t));
            const double front = front_at(ranges<T>{a, b}, double(t));
            area += (std::min(front, 1.0) - depth_at(m, double(t))) * step;
            if (front == nowhere) gap += step;
            else shift = std::max(shift, front - depth_at(m, double(t)));
        }
        // Of 64 strips five hold an end or the crossing, each wrong by its width and a depth of 4 at most; in the
        // others a strip's middle stands for a line exactly.
        const double own = a.id == b.id ? 0 : double(range_duration(a)) + double(range_duration(b));
        REQUIRE(std::abs(double(pair.cost) - own - area) <= 5 * 4 * step + 64 * u<T>);
        REQUIRE(std::abs(double(pair.gap) - gap) <= 2 * step + 4 * u<T>);
        REQUIRE(shift <= double(pair.shift) + 32 * u<T>);
    }
}

// Where the next depth is farther than the slack, it is known who is in front.
TEST_CASE_TEMPLATE("resolve: the front-most at a thousand times, by depth and id; spans one after another", T, float,
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

TEST_CASE_TEMPLATE("insertion in any order: one list, one resolve, bit for bit, while there is room", T, float, double)
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

// Full lists: however many ranges come, and in whatever order, no receiver behind one of them is lit, at any time. For
// a list's depth lines that is strict, range_depth is 10 2^-p off, and the receiver has a rounding of its own. And the
// two costs are bounds.
TEST_CASE_TEMPLATE("full lists: nothing leaves the shadow, and what becomes dark is counted", T, float, double)
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

TEST_CASE_TEMPLATE("one id stays one id where it can; a merged range shadows everybody", T, float, double)
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

// A receiver at rest: the resolved list by closed form, against the front of many times.
TEST_CASE_TEMPLATE("a receiver at rest under a resolved list", T, float, double)
{
    bit_source bits(7);
    constexpr int times = 20'000;
    for (std::int64_t i = 0; i < effort(100); ++i) {
        const auto all = any_ranges<T>(6, bits);
        const auto resolved = range_list_resolve(list_of<16>(all));
        const T z = T(bits.uniform(-1, 1));
        const static_receiver<T> at_rest = static_receiver_begin(z, T(9), T(0), T(1));
        double box = 0, tent = 0;
        for (int k = 0; k < times; ++k) {
            const double t = (k + 0.5) / times;
            if (!(front_at(all, t) < double(z))) continue;
            box += 1.0 / times;
            tent += (t < 0.5 ? 4 * t : 4 - 4 * t) / times;
        }
        // Up to 2 changes for each of 16 ranges, half a time off each; a level range at the receiver's very depth
        // aside.
        static_receiver<T> by_box = at_rest, by_tent = at_rest;
        for (const auto& range : resolved.ranges) {
            by_box = add_range(by_box, range, box_shutter{});
            by_tent = add_range(by_tent, range, tent_shutter{});
        }
        CHECK(std::abs(double(static_receiver_end(by_box)) - box) <= 16.0 / times + 1e-4);
        CHECK(std::abs(double(static_receiver_end(by_tent)) - tent) <= 32.0 / times + 2e-4);
    }
}

TEST_CASE_TEMPLATE("hostile ranges and lists: finite, in order, and always an end", T, float, double)
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
