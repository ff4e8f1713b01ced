// Claims about lists of ranges: full lists are strictly in front of all inserted ranges, and receivers lose a shadow to
// left-out ranges only by their ids.
#include "support/climber.hpp"

#include <gnomon/motion/range/range_cover.h>
#include <gnomon/motion/range/range_list.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

using exact = long double;
template <class T> using ranges = std::vector<depth_time_range<T>>;

/// Depth in extended precision.
template <class T> exact depth_at(const depth_time_range<T>& r, exact t)
{
    const exact passed = (t - exact(r.t0)) / (exact(r.t1) - exact(r.t0));
    return exact(r.z0) * (1 - passed) + exact(r.z1) * passed;
}

constexpr exact nowhere = 2;

exact front_at(const auto& all, exact t)
{
    exact z = nowhere;
    for (const auto& r : all)
        if (exact(r.t0) <= t && t < exact(r.t1)) z = std::min(z, depth_at(r, t));
    return z;
}

/// Ranges of all durations from an ulp to the whole shutter, of all slopes, some of them level.
template <class T> ranges<T> climbed_ranges(std::size_t count, const std::vector<double>& p)
{
    ranges<T> all;
    for (std::size_t k = 0; k < 5 * count; k += 5) {
        const T t = T(p[k]), z = T(2 * p[k + 2] - 1);
        all.push_back(
            {t, std::min(T(1), t + T(std::exp2(-26 * p[k + 1]))), z, p[k + 4] < 0.3 ? z : T(2 * p[k + 3] - 1), T(k)});
    }
    return all;
}

/// Ends and crossings of all ranges, and the neighbours of these in T.
template <class T> std::vector<exact> critical_times(const ranges<T>& all)
{
    std::vector<exact> times;
    const auto add = [&](exact t) {
        T beside = std::nextafter(T(t), T(-1));
        for (int k = 0; k < 3; ++k, beside = std::nextafter(beside, T(2))) times.push_back(exact(beside));
    };
    for (const auto& a : all) {
        add(exact(a.t0)), add(exact(a.t1));
        for (const auto& b : all) {
            const auto slope = [](const auto& r) { return (exact(r.z1) - exact(r.z0)) / (exact(r.t1) - exact(r.t0)); };
            const exact t = exact(a.t0) + (depth_at(b, exact(a.t0)) - exact(a.z0)) / (slope(a) - slope(b));
            if (exact(a.t0) < t && t < exact(a.t1)) times.push_back(t), add(t);
        }
    }
    return times;
}

/// Largest distance of a list's front behind that of the inserted ranges.
template <class T, int capacity> double behind(const ranges<T>& all)
{
    range_list<T, capacity> list = range_list_make<T, capacity>({});
    for (const auto& r : all) list = range_list_insert(list, r);
    exact worst = 0;
    for (const exact t : critical_times(all)) {
        const exact front = front_at(all, t);
        if (front < nowhere) worst = std::max(worst, front_at(list.ranges, t) - front);
    }
    return double(worst);
}

template <class T> T shadow(const auto& all, T t, T z, T id, T bias)
{
    T most = 0;
    for (const auto& r : all) most = std::max(most, range_intensity(r, t, z, id, bias));
    return most;
}

/// Ranges on a grid, on which depths and times are exact.
template <class T> ranges<T> grid_ranges(bit_source& bits)
{
    ranges<T> all;
    for (std::size_t count = 1 + bits.below(6); count > 0; --count) {
        const T t = T(bits.below(8)) / 8, z = T(bits.below(9)) / 4 - 1;
        all.push_back({t, t + T(1 + bits.below(std::size_t(8 - 8 * t))) / 8, z, z, T(bits.below(3))});
    }
    return all;
}

} // namespace

// The reference itself rounds by 2^-52.
TEST_CASE_TEMPLATE("full lists are strictly in front of all inserted ranges, however steep and brief", T, float, double)
{
    const summit small = climb(20, 60'000, 1, [](const auto& p) { return behind<T, 2>(climbed_ranges<T>(4, p)); });
    CHECK(small.score <= 0x1p-52);
    const summit usual = climb(50, 20'000, 2, [](const auto& p) { return behind<T, 8>(climbed_ranges<T>(10, p)); });
    CHECK(usual.score <= 0x1p-52);
}

// Times lie between those of the grid, at which ranges begin and end.
TEST_CASE_TEMPLATE("ids: a shadow is lost only where a range of the receiver's id is in front of the receiver", T,
                   float, double)
{
    bit_source bits(3);
    std::int64_t shadowed = 0, lost_in_list = 0, lost_in_front = 0, lost_behind_cover = 0;
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        const ranges<T> all = grid_ranges<T>(bits);
        range_list<T, 8> list = range_list_make<T, 8>({});
        range_cover<T> state = range_cover_begin(T(1));
        for (const auto& r : all) list = range_list_insert(list, r), state = range_cover_add(state, r);
        const range_list<T, 8> resolved = range_list_resolve(list);
        const depth_time_range<T> cover = range_cover_end(state);
        ranges<T> kept;
        for (const auto& r : all)
            if (range_cover_occludes(cover, r) == 0) kept.push_back(r);

        const T t = (T(bits.below(8)) + T(0.5)) / 8, z = T(bits.below(17)) / 8 - 1, id = T(bits.below(4));
        const T bias = T(bits.below(3)) / 8;
        const T whole = shadow(all, t, z, id, bias);
        const bool own_in_front = std::ranges::any_of(
            all, [&](const auto& r) { return r.id == id && r.t0 <= t && t <= r.t1 && r.z0 + bias < z; });
        const auto ask = [&](T answer, std::int64_t& lost) {
            REQUIRE(answer <= whole);
            if (!own_in_front) REQUIRE(answer == whole);
            lost += answer < whole;
        };
        ask(range_list_intensity(list, t, z, id, bias), lost_in_list);
        ask(range_list_intensity(resolved, t, z, id, bias), lost_in_front);
        ask(shadow(kept, t, z, id, bias), lost_behind_cover);
        const auto answer = range_cover_answer(cover, t, z, id, bias);
        if (answer.decided > 0) REQUIRE(answer.intensity == whole);
        shadowed += whole > 0;
    }
    CHECK(4 * shadowed > effort(100'000));
    for (const std::int64_t lost : {lost_in_list, lost_in_front, lost_behind_cover}) CHECK((lost > 0 || draws_few()));
}

// A box above a table, both of one object or each with an id of its own.
TEST_CASE("ids of whole objects lose the shadows that others cast on them")
{
    const auto bottom = [](double lid_id, double bottom_id) {
        range_list<double> list = range_list_make<double>({0.0, 1.0, -0.5, -0.5, lid_id});
        list = range_list_insert(list, {0.0, 1.0, 0.0, 0.0, 7.0}); // something else inside
        return range_list_intensity(list, 0.5, 0.5, bottom_id, 0.0);
    };
    CHECK(bottom(1, 1) == 0);
    CHECK(bottom(1, 2) == 1);
}
