// Shared by tests of receivers: lists of disjoint ranges, shutters by their definition, and the light that a receiver
// loses to one range in extended precision, with the error that the comments in motion/ state.
#pragma once

#include "support/hostile.hpp"

#include <gnomon/passes/range/shutters.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace gnomon::test {

using wide = long double;
template <class T> constexpr wide rounding = wide(std::numeric_limits<T>::epsilon()) / 2;

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

enum class response { box, tent, piecewise, line };
inline constexpr std::array responses{response::box, response::tent, response::piecewise, response::line};

/// A shutter by the kernels and by its definition.
template <class T> struct test_shutter {
    response kind;
    T begin, end;
    shutter_weights<T> weights;

    std::array<wide, 8> eighths() const
    {
        const auto& w = weights;
        return {wide(w.w0), wide(w.w1), wide(w.w2), wide(w.w3), wide(w.w4), wide(w.w5), wide(w.w6), wide(w.w7)};
    }
    /// The shares of the weights of a line; a half each without weights.
    std::array<wide, 2> ends() const
    {
        const wide a = wide(weights.w0), b = wide(weights.w1);
        return a + b > 0 ? std::array{a / (a + b), b / (a + b)} : std::array{0.5L, 0.5L};
    }
    /// At a share x of the exposure; 1 on average.
    wide density(wide x) const
    {
        if (x < 0 || x >= 1) return 0;
        if (kind == response::box) return 1;
        if (kind == response::tent) return x < 0.5L ? 4 * x : 4 - 4 * x;
        if (kind == response::line) return 2 * (ends()[0] * (1 - x) + ends()[1] * x);
        return 8 * eighths()[std::size_t(8 * x)];
    }
    wide largest() const
    {
        const auto e = eighths();
        if (kind == response::box) return 1;
        if (kind == response::tent) return 2;
        return kind == response::line ? 2 * std::max(ends()[0], ends()[1]) : 8 * *std::max_element(e.begin(), e.end());
    }
    wide let_in(wide t) const
    {
        const wide x = std::clamp((t - wide(begin)) / (wide(end) - wide(begin)), 0.0L, 1.0L);
        if (kind == response::box) return x;
        if (kind == response::tent) return x < 0.5L ? 2 * x * x : 1 - 2 * (1 - x) * (1 - x);
        if (kind == response::line) return 2 * ends()[0] * x + (ends()[1] - ends()[0]) * x * x;
        wide sum = 0;
        for (std::size_t k = 0; k < 8; ++k) sum += eighths()[k] * std::clamp(8 * x - wide(k), 0.0L, 1.0L);
        return sum;
    }
    template <class Visit> auto by(const Visit& visit) const
    {
        return kind == response::box    ? visit(box_shutter{})
               : kind == response::tent ? visit(tent_shutter{})
               : kind == response::line ? visit(linear_shutter<T>{weights.w0, weights.w1})
                                        : visit(piecewise_shutter<T>{weights});
    }
    template <class Receiver> Receiver add(const Receiver& state, const depth_time_range<T>& r) const
    {
        return by([&](const auto& shutter) { return add_range(state, r, shutter); });
    }
    auto filter(const moving_receiver<T>& state, const depth_time_range<T>& r) const
    {
        return by([&](const auto& shutter) { return add_filtered_range(state, r, shutter); });
    }
};

template <class T> test_shutter<T> any_shutter(response kind, T begin, T end, bit_source& bits)
{
    const auto w = [&] { return T(bits.chance(0.3) ? 0 : bits.uniform(0, 1)); };
    return {kind, begin, end, shutter_weights_make(shutter_weights<T>{w(), w(), w(), w(), w(), w(), w(), w()})};
}

template <class T> wide exact_depth(const depth_time_range<T>& r, wide t)
{
    return wide(r.z0) + (t - wide(r.t0)) / (wide(r.t1) - wide(r.t0)) * (wide(r.z1) - wide(r.z0));
}

/// Share of the light that a receiver with this depth line loses to one range from begin to end, and the error that a
/// kernel may have. The line lasts from begin to end or longer.
struct loss {
    wide share, error;
};
template <class T>
loss exact_loss(const depth_time_range<T>& r, const depth_time_range<T>& receiver, T begin, T end,
                const test_shutter<T>& shutter)
{
    const wide early = std::max(wide(begin), wide(r.t0)), late = std::min(wide(end), wide(r.t1));
    if (r.id == receiver.id || !(early < late)) return {0, 0};
    const wide ahead0 = exact_depth(receiver, early) - exact_depth(r, early);
    const wide ahead1 = exact_depth(receiver, late) - exact_depth(r, late);
    const auto passes = [&](wide level) { // when it is so far ahead, as a share
        return std::clamp((ahead0 - level) / (ahead0 - ahead1), 0.0L, 1.0L);
    };
    const bool level = ahead0 == ahead1;
    const wide meeting = level ? early : early + passes(0) * (late - early);
    const wide from = ahead0 > 0 ? early : ahead1 > 0 ? meeting : late;
    const wide to = ahead1 > 0 ? late : ahead0 > 0 ? meeting : early;
    const double largest = std::max(
        {std::abs(double(r.z0)), std::abs(double(r.z1)), std::abs(double(receiver.z0)), std::abs(double(receiver.z1))});
    const wide slack = 26 * wide(largest) * rounding<T>;
    const wide undecided = level ? wide(std::abs(ahead0) <= slack) : std::abs(passes(slack) - passes(-slack));
    const wide error = (undecided * (late - early) + 32 * rounding<T>) / (wide(shutter.end) - wide(shutter.begin));
    return {from < to ? shutter.let_in(to) - shutter.let_in(from) : 0, shutter.largest() * error};
}

} // namespace gnomon::test
