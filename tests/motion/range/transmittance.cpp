// Steps of transmittance: contiguous, few, exact products in between; and the mean over the shutter interval against
// many times, against the sum over all sets of ranges, and against opaque lists.
#include "list_cases.hpp"

#include <gnomon/motion/range/range_transmittance.h>
#include <gnomon/motion/receiver/static_receiver.h>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <rapidcheck.h>

#include <array>
#include <cmath>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

using high = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<120>, boost::multiprecision::et_off>;

template <class T> struct veils {
    ranges<T> hidden;
    std::vector<T> opacities;
};

constexpr double own = 3; // the receiver's id, which any_range draws, too

template <class T> veils<T> any_veils(bit_source& bits)
{
    veils<T> v{any_ranges<T>(bits.below(9), bits), {}};
    for (std::size_t i = 0; i < v.hidden.size(); ++i)
        v.opacities.push_back(T(bits.chance(0.3) ? double(bits.below(5)) / 4 : bits.uniform(0, 1)));
    return v;
}

template <class T> std::vector<range_transmittance<T>> steps_of(const veils<T>& v, T begin, T end)
{
    std::vector<range_transmittance<T>> result;
    for (T t = begin; t < end; t = result.back().t1) {
        result.push_back(range_transmittance_begin(t, end));
        for (std::size_t i = 0; i < v.hidden.size(); ++i)
            result.back() = range_transmittance_add(result.back(), v.hidden[i], T(own), v.opacities[i]);
    }
    return result;
}

template <class T> bool counts(const range<T>& r) { return lasts(r) && r.id != T(own); }

/// The transmittance at time t by its definition.
template <class T> high transmittance_at(const veils<T>& v, const high& t)
{
    high product = 1;
    for (std::size_t i = 0; i < v.hidden.size(); ++i)
        if (counts(v.hidden[i]) && high(v.hidden[i].t0) <= t && t < high(v.hidden[i].t1))
            product *= 1 - high(v.opacities[i]);
    return product;
}

/// The mean transmittance from time 0 to 1 by inclusion and exclusion: the sum over all sets of ranges of the time that
/// they share, times the product of -opacity. It shares nothing with steps.
template <class T> high mean_by_sets(const veils<T>& v)
{
    high mean = 0;
    for (std::size_t set = 0; set < (std::size_t(1) << v.hidden.size()); ++set) {
        high from = 0, to = 1, product = 1;
        for (std::size_t i = 0; i < v.hidden.size(); ++i) {
            if (!(set >> i & 1)) continue;
            const range<T>& r = v.hidden[i];
            if (!counts(r)) product = 0;
            from = std::max(from, high(r.t0)), to = std::min(to, high(r.t1)), product *= -high(v.opacities[i]);
        }
        if (from < to) mean += (to - from) * product;
    }
    return mean;
}

template <class T> T lost_to(const veils<T>& v, T begin, T end)
{
    static_receiver<T> state = static_receiver_begin(T(1), T(own), begin, end);
    for (const auto& step : steps_of(v, begin, end))
        state = static_receiver_add(
            state, range_transmittance_lost(step, shutter_box(step.t0, begin, end), shutter_box(step.t1, begin, end)));
    return static_receiver_end(state);
}

} // namespace

TEST_CASE_TEMPLATE("steps of transmittance are contiguous, at most 2 n + 1, and within the stated error", T, float,
                   double)
{
    bit_source bits(71);
    std::size_t most = 0;
    for (std::int64_t i = 0; i < effort(20'000); ++i) {
        const auto v = any_veils<T>(bits);
        const T begin = bits.chance(0.5) ? T(0) : T(bits.uniform(0, 0.5));
        const T end = bits.chance(0.5) ? T(1) : T(bits.uniform(0.5, 1));
        T reached = begin;
        const auto steps = steps_of(v, begin, end);
        for (const auto& step : steps) {
            REQUIRE(step.t0 == reached);
            REQUIRE(step.t0 < step.t1);
            reached = step.t1;
            // Halfway, at the begin, and just before the end.
            const high n = double(v.hidden.size()), share = high(2 * u<T>) * n;
            for (const double passed : {0.0, 0.5, 0.999}) {
                const high expected = transmittance_at(v, step.t0 + passed * (high(step.t1) - high(step.t0)));
                REQUIRE(abs(high(step.transmittance) - expected) <= share * expected);
            }
        }
        REQUIRE(reached == end);
        REQUIRE(steps.size() <= 2 * v.hidden.size() + 1);
        most = std::max(most, steps.size());
    }
    CHECK(most > 6);
}

TEST_CASE("the mean transmittance is the sum over all sets of ranges")
{
    CHECK(rc::check("lost light is 1 less that sum, within the stated errors of all steps", [](std::uint32_t seed) {
        bit_source bits(seed);
        const auto v = any_veils<float>(bits);
        const double n = double(v.hidden.size()), steps = 2 * n + 1;
        // Each step loses 2 n + 4 roundings of its share, whose own are 4, and the sum one more.
        const high error = u<float> * (2 * n + 4 + 5 * steps);
        RC_ASSERT(abs(1 - high(lost_to(v, 0.f, 1.f)) - mean_by_sets(v)) <= error);
        RC_ASSERT(abs(1 - high(lost_to(veils<double>{ranges<double>{}, {}}, 0.0, 1.0)) - 1) == 0);
    }));
}

TEST_CASE("neither the order of ranges nor a cut in one changes more than roundings")
{
    CHECK(rc::check("reversed and cut", [](std::uint32_t seed) {
        bit_source bits(seed);
        const auto v = any_veils<double>(bits);
        veils<double> other;
        for (std::size_t i = v.hidden.size(); i-- > 0;) {
            const double cut = bits.uniform(0, 1);
            for (const auto& part : {range_clip(v.hidden[i], 0.0, cut), range_clip(v.hidden[i], cut, 1.0)})
                other.hidden.push_back(part), other.opacities.push_back(v.opacities[i]);
        }
        RC_ASSERT(std::abs(lost_to(v, 0.0, 1.0) - lost_to(other, 0.0, 1.0)) <= 1000 * u<double>);
    }));
}

TEST_CASE_TEMPLATE("a receiver in front of, among and behind translucent ranges that overlap", T, float, double)
{
    // Two veils cross at time 1/2 in depth; the receiver is between them, then behind both from 3/4 on.
    const std::array<range<T>, 2> list{{{T(0), T(1), T(-1), T(1), T(1)}, {T(0), T(1), T(1), T(-1), T(2)}}};
    const auto lost = [&](T z, T id, T first, T second) {
        const auto state = static_receiver_begin(z, id, T(0), T(1));
        veils<T> v;
        for (const auto& r : list) {
            auto hidden = static_receiver_occluding_part(state, r);
            hidden.id = hidden.id == id ? T(own) : T(9);
            v.hidden.push_back(hidden);
        }
        v.opacities = {first, second};
        return lost_to(v, T(0), T(1));
    };
    CHECK(lost(T(-1), T(7), T(0.5), T(0.5)) == 0);
    CHECK(lost(T(2), T(7), T(0.5), T(0.5)) == T(0.75));
    CHECK(lost(T(0), T(7), T(0.5), T(0.5)) == T(0.5));     // one of them at each time
    CHECK(lost(T(0.5), T(7), T(0.5), T(0.5)) == T(0.625)); // both for a half of the time
    CHECK(lost(T(0.5), T(1), T(0.5), T(0.5)) == T(0.375)); // without its own
    CHECK(lost(T(2), T(7), T(1), T(0.5)) == 1);
    CHECK(lost(T(2), T(7), T(-3), T(0)) == 0);
    CHECK(lost(T(2), T(7), std::numeric_limits<T>::quiet_NaN(), T(0.5)) == T(0.5));
}
