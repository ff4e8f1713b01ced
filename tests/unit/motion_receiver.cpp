// A receiver at rest under resolved lists of depth-time ranges: the closed form against a hundred thousand times, and
// what a list must not mind.
#include "../support/effort.hpp"
#include "../support/hostile.hpp"

#include <gnomon/motion/static_receiver.h>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

using namespace gnomon;
using gnomon::test::bit_source;

namespace {

/// Ranges one after the other, some of them touching, in any order of ids.
template <class T> std::vector<depth_time_range<T>> resolved_list(bit_source& bits)
{
    std::vector<double> times(2 * (1 + bits.below(4)));
    for (double& t : times) t = bits.chance(0.2) ? double(bits.below(5)) / 4 : bits.uniform(0, 1);
    std::sort(times.begin(), times.end());
    std::vector<depth_time_range<T>> list;
    for (std::size_t i = 0; i + 1 < times.size(); i += bits.chance(0.5) ? 1 : 2)
        list.push_back(
            {T(times[i]), T(times[i + 1]), T(bits.uniform(-1, 1)), T(bits.uniform(-1, 1)), T(bits.below(3))});
    return list;
}

template <class T> T intensity(const std::vector<depth_time_range<T>>& list, T z, T id, T begin, T end, bool tent)
{
    static_receiver<T> state = static_receiver_begin(z, id, begin, end);
    for (const auto& r : list) state = tent ? static_receiver_add_tent(state, r) : static_receiver_add_box(state, r);
    return static_receiver_end(state);
}

/// What it loses to one range, box or tent, in extended precision, and how far off the comment lets the kernel be.
struct loss {
    double share, error;
};
template <class T> loss exact_loss(const depth_time_range<T>& r, T z, T begin, T end, bool tent)
{
    using wide = long double;
    constexpr double u = double(std::numeric_limits<T>::epsilon()) / 2;
    const wide before0 = wide(z) - wide(r.z0), before1 = wide(z) - wide(r.z1);
    const bool meets = (before0 > 0) != (before1 > 0);
    const wide meeting = meets ? wide(r.t0) + before0 / (before0 - before1) * (wide(r.t1) - wide(r.t0)) : 0;
    const wide from = before0 > 0 ? wide(r.t0) : before1 > 0 ? meeting : 1;
    const wide to = before1 > 0 ? wide(r.t1) : before0 > 0 ? meeting : 0;
    const auto let_in = [&](wide t) {
        const wide x = std::clamp((t - wide(begin)) / (wide(end) - wide(begin)), 0.0L, 1.0L);
        return !tent ? x : x < 0.5L ? 2 * x * x : 1 - 2 * (1 - x) * (1 - x);
    };
    const double largest = std::max({std::abs(double(z)), std::abs(double(r.z0)), std::abs(double(r.z1))});
    const double change = std::abs(double(r.z1) - double(r.z0));
    const double once = meets ? (6 * largest / change + 14) * u / (double(end) - double(begin)) : 8 * u;
    return {from < to ? double(let_in(to) - let_in(from)) : 0.0, tent ? 2 * once : once};
}

} // namespace

TEST_CASE_TEMPLATE("static receiver: within the stated error", T, float, double)
{
    bit_source bits(13);
    for (std::int64_t i = 0; i < test::effort(100'000); ++i) {
        const auto list = resolved_list<T>(bits);
        const T z = T(bits.uniform(-1, 1)), begin = T(bits.uniform(0, 0.5)), end = T(bits.uniform(0.5, 1));
        const bool tent = i % 2 == 1;
        if (!(begin < end)) continue;
        loss all{0, 0};
        for (const auto& r : list) {
            const loss one = exact_loss(r, z, begin, end, tent);
            all = {all.share + one.share, all.error + one.error};
        }
        REQUIRE(std::abs(double(intensity(list, z, T(9), begin, end, tent)) - all.share) <= all.error);
    }
}

TEST_CASE_TEMPLATE("static receiver: the closed form is what a hundred thousand times say", T, float, double)
{
    constexpr int times = 100'000;
    bit_source bits(11);
    for (std::int64_t i = 0; i < test::effort(200); ++i) {
        const auto list = resolved_list<T>(bits);
        const T z = T(bits.uniform(-1, 1)), id = T(bits.below(3));
        const T a = T(bits.uniform(0, 1)), b = T(bits.uniform(0, 1));
        const T begin = i % 2 ? T(0) : std::min(a, b), end = i % 2 ? T(1) : std::max(a, b);
        if (double(end) - double(begin) < 0.01) continue;
        double box = 0, tent = 0;
        for (int k = 0; k < times; ++k) {
            const double x = (k + 0.5) / times;
            const double t = double(begin) + x * (double(end) - double(begin));
            const auto hides = [&](const depth_time_range<T>& r) {
                const double depth =
                    double(r.z0) + (t - double(r.t0)) / (double(r.t1) - double(r.t0)) * (double(r.z1) - double(r.z0));
                return double(r.t0) <= t && t < double(r.t1) && depth < double(z) && r.id != id;
            };
            if (std::any_of(list.begin(), list.end(), hides)) {
                box += 1.0 / times;
                tent += (x < 0.5 ? 4 * x : 4 - 4 * x) / times;
            }
        }
        // Each of up to 7 ranges begins and ends within one of the times; the tent's density is 2 at most.
        CHECK(std::abs(double(intensity(list, z, id, begin, end, false)) - box) <= 14.0 / times + 1e-5);
        CHECK(std::abs(double(intensity(list, z, id, begin, end, true)) - tent) <= 28.0 / times + 1e-5);
    }
}

TEST_CASE_TEMPLATE("static receiver: the order of the list and cuts in it change nothing but roundings", T, float,
                   double)
{
    bit_source bits(12);
    for (int i = 0; i < 2000; ++i) {
        auto list = resolved_list<T>(bits);
        const T z = T(bits.uniform(-1, 1));
        const double first = double(intensity(list, z, T(9), T(0), T(1), i % 2 == 1));
        std::reverse(list.begin(), list.end());
        const T cut = T(bits.uniform(0, 1));
        const auto whole = list;
        for (auto& r : list) r = range_clip(r, T(0), cut);
        for (const auto& r : whole) list.push_back(range_clip(r, cut, T(1)));
        const double again = double(intensity(list, z, T(9), T(0), T(1), i % 2 == 1));
        // A cut moves the depth line by 5 roundings of it, and so the meeting by as much over its slope: where the
        // depth hardly changes, by any time, so not looked at here.
        const bool level = std::any_of(whole.begin(), whole.end(),
                                       [](const auto& r) { return std::abs(double(r.z1) - double(r.z0)) < 0.01; });
        if (!level) CHECK(std::abs(first - again) <= 7 * 2e4 * double(std::numeric_limits<T>::epsilon()));
    }
}

TEST_CASE_TEMPLATE("static receiver: nothing, everything, its own surface, half, NaN", T, float, double)
{
    const T nan = std::numeric_limits<T>::quiet_NaN();
    const depth_time_range<T> all{T(0), T(1), T(-0.5), T(0.5), T(1)};
    for (const bool tent : {false, true}) {
        CHECK(intensity<T>({}, T(0), T(2), T(0), T(1), tent) == 0);
        CHECK(intensity<T>({all}, T(0.75), T(2), T(0), T(1), tent) == 1);
        CHECK(intensity<T>({all}, T(-0.75), T(2), T(0), T(1), tent) == 0);
        CHECK(intensity<T>({all}, T(0.75), T(1), T(0), T(1), tent) == 0);
        CHECK(intensity<T>({all}, T(0), T(2), T(0), T(1), tent) == T(0.5));
        CHECK(intensity<T>({all}, nan, T(2), T(0), T(1), tent) == 0);
        CHECK(intensity<T>({all}, T(0.75), T(2), nan, T(1), tent) == 0);
        CHECK(intensity<T>({{T(0), nan, T(-1), T(-1), T(1)}}, T(0.75), T(2), T(0), T(1), tent) == 0);
    }
}
