// Maps of resolved lists under a moving receiver, its shadow by the kernels and by many samples in extended precision.
#pragma once

#include "receiver_paths.hpp"
#include "support/effort.hpp"

#include <doctest/doctest.h>

namespace gnomon::test {

inline constexpr int side = 16, margin = 2; // texels of the map, and around it for filters
inline constexpr int times = 4096;

template <class T> using texel_list = std::vector<depth_time_range<T>>;

template <class T> struct test_map {
    std::vector<texel_list<T>> lists;
    const texel_list<T>& at(T column, T row) const
    {
        REQUIRE((column >= -margin && column < side - margin && row >= -margin && row < side - margin));
        return lists[std::size_t(int(row) + margin) * side + std::size_t(int(column) + margin)];
    }
};

template <class T> test_map<T> any_map(bit_source& bits)
{
    test_map<T> map;
    for (int i = 0; i < side * side; ++i) map.lists.push_back(resolved_list<T>(bits));
    return map;
}

template <class T> test_map<T> uniform_map(const depth_time_range<T>& r) { return {{side * side, {r}}}; }

template <class T> T nearest(const test_map<T>& map, const receiver_path<T>& p, const test_shutter<T>& s)
{
    moving_receiver<T> state = moving_receiver_begin(p, s.begin, s.end);
    for_each_texel(p, [&](const texel_sweep<T>& sweep) {
        state = moving_receiver_texel(state, sweep);
        for (const auto& r : map.at(sweep.column, sweep.row)) state = s.add(state, r);
    });
    return moving_receiver_end(state);
}

template <class T>
T filtered(const test_map<T>& map, const receiver_path<T>& p, const test_shutter<T>& s, int look_ups = 1)
{
    moving_receiver<T> state = moving_receiver_begin(p, s.begin, s.end);
    const T back = T(-0.5) * T(look_ups);
    for_each_texel(receiver_path_shift(p, back, back), [&](const texel_sweep<T>& sweep) {
        for (int j = 0; j <= look_ups; ++j)
            for (int i = 0; i <= look_ups; ++i) {
                state = moving_receiver_tap(state, sweep, T(i), T(j), T(look_ups));
                for (const auto& r : map.at(sweep.column + T(i), sweep.row + T(j))) state = s.filter(state, r);
            }
    });
    return moving_receiver_end(state);
}

template <class T> bool hides(const texel_list<T>& list, const receiver_path<T>& p, wide t)
{
    const wide z = exact_depth(p.depth, t);
    return std::any_of(list.begin(), list.end(), [&](const depth_time_range<T>& r) {
        return wide(r.t0) <= t && t < wide(r.t1) && exact_depth(r, t) < z && r.id != p.depth.id;
    });
}

/// The mean over many times in the exposure, by definition.
template <class T>
wide sampled(const test_map<T>& map, const receiver_path<T>& p, const test_shutter<T>& s, bool bilinear)
{
    wide sum = 0;
    for (int k = 0; k < times; ++k) {
        const wide x = (k + 0.5L) / times, t = wide(s.begin) + x * (wide(s.end) - wide(s.begin));
        if (t < wide(p.depth.t0) || t > wide(p.depth.t1)) continue;
        const exact_position at = exact_path_at(p, t);
        const wide off = bilinear ? 0.5L : 0, column = std::floor(at.x - off), row = std::floor(at.y - off);
        const wide u = at.x - off - column, v = at.y - off - row;
        wide hidden = 0;
        for (int i = 0; i < (bilinear ? 4 : 1); ++i) {
            const wide weight = bilinear ? (i % 2 ? u : 1 - u) * (i / 2 ? v : 1 - v) : 1;
            if (hides(map.at(T(column + i % 2), T(row + i / 2)), p, t)) hidden += weight;
        }
        sum += s.density(x) * hidden / times;
    }
    return sum;
}

/// True if the path runs along a border of texels, where rounding decides between them.
template <class T> bool between_texels(const receiver_path<T>& p)
{
    const auto near = [](wide a, wide b) { return std::abs(a - std::round(a)) + std::abs(b - std::round(a)) < 1e-5L; };
    return near(wide(p.x0) / wide(p.w0), wide(p.x1) / wide(p.w1)) ||
           near(wide(p.y0) / wide(p.w0), wide(p.y1) / wide(p.w1));
}

/// Largest distance of the closed form from the mean over that many times.
template <class T>
wide sampling_error(const test_map<T>& map, const receiver_path<T>& p, const test_shutter<T>& s, bool bilinear)
{
    wide events = 11, undecided = 0, chord = 0; // the path's ends, the shutter's own breaks
    const T back = bilinear ? T(-0.5) : T(0);
    const receiver_path<T> path = receiver_path_shift(p, back, back);
    const wide exposure = wide(s.end) - wide(s.begin);
    for_each_texel(path, [&](const texel_sweep<T>& sweep) {
        events += 1;
        for (int i = 0; i < (bilinear ? 4 : 1); ++i)
            for (const auto& r : map.at(sweep.column + T(i % 2), sweep.row + T(i / 2))) {
                events += 3; // begins, meets, ends
                undecided += exact_loss(r, p.depth, sweep.t_begin, sweep.t_end, s).error;
            }
        if (!(sweep.t_begin < sweep.t_end)) return;
        const exact_position a = exact_path_at(path, wide(sweep.t_begin)), b = exact_path_at(path, wide(sweep.t_end));
        const wide root = std::sqrt(std::max(a.w / b.w, b.w / a.w)), part = wide(sweep.t_end) - wide(sweep.t_begin);
        if (bilinear) chord += part / exposure * (std::abs(a.x - b.x) + std::abs(a.y - b.y)) * (root - 1) / (root + 1);
        // A border's time by the comment of texel_border_share, x and |c| w being 32 at most.
        const bool sideways = sweep.across_column <= sweep.across_row;
        const T texel = sideways ? sweep.column : sweep.row, last = sideways ? sweep.last_column : sweep.last_row;
        if (bilinear || texel == last) return;
        const wide border = wide(texel) + (texel < last ? 1 : 0);
        const wide distance0 = wide(sideways ? p.x0 : p.y0) - border * wide(p.w0);
        const wide distance1 = wide(sideways ? p.x1 : p.y1) - border * wide(p.w1);
        undecided += s.largest() * (4 * 128 / std::abs(distance0 - distance1) + 2) * rounding<T> / exposure;
    });
    // An event between two times costs half a step. So does, by a weight's slope, the second order of at most 4 lengths
    // per exposure. Bilinear positions have the precision of the map's 32 texels.
    const wide slope = 4 * 32 / (wide(p.depth.t1) - wide(p.depth.t0)) * exposure;
    const wide smooth = bilinear ? events * slope / (8.0L * times * times) + 4 * 8 * 32 * 5 * rounding<T> : 0;
    return s.largest() * (events / (2.0L * times) + smooth + chord) + undecided;
}

template <class T> test_shutter<T> exposure_of(const receiver_path<T>& p, std::size_t i, bit_source& bits)
{
    const bool whole = i / responses.size() % 2 == 0;
    return any_shutter(responses[i % responses.size()], whole ? p.depth.t0 : T(0), whole ? p.depth.t1 : T(1), bits);
}

} // namespace gnomon::test
