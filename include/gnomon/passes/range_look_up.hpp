// What a receiver gets from a map of depth-time ranges, with percentage-closer filtering of K x K bilinear look-ups:
// K = 1 is bilinear filtering. At one time, by samples in time, at rest in closed form, and on its way in closed form;
// the kernels are those of motion/, this is their loop over texels and lists. Shadow intensity, 0 lit and 1 in shadow.
// What lies outside of the map is lit.
#ifndef GNOMON_PASSES_RANGE_LOOK_UP_HPP
#define GNOMON_PASSES_RANGE_LOOK_UP_HPP

#include "../motion/moving_receiver.h"
#include "../motion/receiver_path.h"
#include "../motion/static_receiver.h"
#include "range_map.hpp"

#include <algorithm>
#include <cstddef>

namespace gnomon {

/// What a shutter that opens and closes at once takes, for the look-ups below; a lambda does it for any other shutter.
struct box_shutter {
    template <class T> static_receiver<T> operator()(const static_receiver<T>& s, const depth_time_range<T>& r) const
    {
        return static_receiver_add_box(s, r);
    }
    template <class T> moving_receiver<T> operator()(const moving_receiver<T>& s, const depth_time_range<T>& r) const
    {
        return moving_receiver_filter_box(s, r);
    }
};

namespace detail {

/// Calls visit(i, j, range) for the ranges of the texels from (column, row) on, K + 1 along either axis.
template <class T, class Visit>
void for_each_range(const range_map<T>& map, T column, T row, int look_ups, const Visit& visit)
{
    const T width = T(map.width), height = T(map.height), reach = T(look_ups);
    // Comparisons that a NaN fails, and indices only from what is inside.
    const int first_i = column >= 0 ? 0 : -column <= reach ? int(-column) : look_ups + 1;
    const int first_j = row >= 0 ? 0 : -row <= reach ? int(-row) : look_ups + 1;
    for (int j = first_j; j <= look_ups && row + T(j) < height; ++j) {
        const std::size_t begin = std::size_t(row + T(j)) * map.width;
        for (int i = first_i; i <= look_ups && column + T(i) < width; ++i) {
            const std::size_t texel = begin + std::size_t(column + T(i));
            for (std::uint32_t k = map.first[texel]; k < map.first[texel + 1]; ++k) visit(i, j, map.ranges[k]);
        }
    }
}

} // namespace detail

/// A receiver at rest at texel position (x, y), of resolved lists; add(state, range) is the shutter.
template <class T, class Add = box_shutter>
T static_shadow(const range_map<T>& map, T x, T y, static_receiver<T> state, int look_ups = 1, const Add& add = {})
{
    const T k = T(look_ups), column = texel_below(x - T(0.5) * k), row = texel_below(y - T(0.5) * k);
    const T u = x - T(0.5) * k - column, v = y - T(0.5) * k - row;
    detail::for_each_range(map, column, row, look_ups, [&](int i, int j, const depth_time_range<T>& r) {
        state = add(static_receiver_weigh(state, texel_weight(u, T(i), k) * texel_weight(v, T(j), k)), r);
    });
    return static_receiver_end(state);
}

/// A receiver on its way from time t0 to t1 of the path, in the exposure from begin to end, of resolved lists.
template <class T, class Add = box_shutter>
T moving_shadow(const range_map<T>& map, const receiver_path<T>& path, T begin, T end, int look_ups = 1,
                const Add& add = {})
{
    const T k = T(look_ups);
    moving_receiver<T> state = moving_receiver_begin(path, begin, end);
    texel_sweep<T> sweep = texel_sweep_begin(receiver_path_shifted(path, T(-0.5) * k, T(-0.5) * k));
    for (;; sweep = texel_sweep_next(sweep)) {
        int last_i = -1, last_j = -1;
        detail::for_each_range(map, sweep.column, sweep.row, look_ups, [&](int i, int j, const depth_time_range<T>& r) {
            if (r.t1 <= sweep.t_begin || sweep.t_end <= r.t0) return;
            if (i != last_i || j != last_j) state = moving_receiver_tap(state, sweep, T(i), T(j), k);
            last_i = i, last_j = j;
            state = add(state, r);
        });
        if (!(sweep.t_end < sweep.path.depth.t1)) return moving_receiver_end(state);
    }
}

/// At one time; lists need not be resolved.
template <class T> T shadow_at(const range_map<T>& map, const receiver_path<T>& path, T t, T bias, int look_ups = 1)
{
    const T k = T(look_ups), z = range_depth(path.depth, t);
    const texel_position<T> at = receiver_path_at(path, t);
    const T column = texel_below(at.x - T(0.5) * k), row = texel_below(at.y - T(0.5) * k);
    const T u = at.x - T(0.5) * k - column, v = at.y - T(0.5) * k - row;
    T shadow = 0, hidden = 0;
    int last_i = -1, last_j = -1;
    const auto add_texel = [&] { shadow += hidden * texel_weight(u, T(last_i), k) * texel_weight(v, T(last_j), k); };
    detail::for_each_range(map, column, row, look_ups, [&](int i, int j, const depth_time_range<T>& r) {
        if (i != last_i || j != last_j) add_texel(), hidden = 0, last_i = i, last_j = j;
        hidden = std::max(hidden, range_intensity(r, t, z, path.depth.id, bias));
    });
    add_texel();
    return saturate_or_zero(shadow);
}

/// By n = max(2 |p_e - p_s|, 5) samples in time, at most `most` (Palmer 2011, 4.1), in the middle of their strata.
template <class T>
T sampled_shadow(const range_map<T>& map, const receiver_path<T>& path, T bias, T most, int look_ups = 1)
{
    const T n = receiver_sample_count(path, most);
    sampled_receiver<T> state = sampled_receiver_begin(n);
    for (T k = 0; k < n; ++k)
        state =
            sampled_receiver_add(state, shadow_at(map, path, receiver_sample_time(path, k, n, T(0.5)), bias, look_ups));
    return sampled_receiver_end(state);
}

} // namespace gnomon
#endif
