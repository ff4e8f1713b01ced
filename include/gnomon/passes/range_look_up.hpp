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
#include <span>
#include <type_traits>

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

/// Calls visit(i, j, texel) for the texels from (column, row) on that are in the map, K + 1 along either axis.
template <class T, class Visit>
void for_each_texel(const range_map<T>& map, T column, T row, int look_ups, const Visit& visit)
{
    const T width = T(map.width), height = T(map.height);
    for (int j = 0; j <= look_ups; ++j) {
        const T y = row + T(j);
        if (!(y >= 0 && y < height)) continue; // a NaN is outside
        for (int i = 0; i <= look_ups; ++i) {
            const T x = column + T(i);
            if (!(x >= 0 && x < width)) continue;
            visit(i, j, map.texel(map.width, std::size_t(x), std::size_t(y)));
        }
    }
}

/// Calls visit(weight, texel) for the texels around (x, y).
template <class T, class Visit>
void for_each_static_texel(const range_map<T>& map, T x, T y, int look_ups, const Visit& visit)
{
    const T k = T(look_ups), left = x - T(0.5) * k, top = y - T(0.5) * k;
    const T column = texel_below(left), row = texel_below(top), u = left - column, v = top - row;
    for_each_texel(map, column, row, look_ups, [&](int i, int j, std::size_t texel) {
        visit(texel_weight(u, T(i), k) * texel_weight(v, T(j), k), texel);
    });
}

/// Calls visit(range) for what counts for a receiver of this id in a resolved list.
template <class T, class Visit>
void for_each_counted(std::span<const depth_time_range<T>> list, T id, const Visit& visit)
{
    depth_time_range<T> front = range_empty(T(range_nothing));
    for (const depth_time_range<T>& r : list) {
        if (!range_is_second_layer(front, r)) front = r;
        else if (!(front.id == id)) continue;
        visit(r);
    }
}

/// By its total where that is enough; else by calling add_list(list).
template <class T, class AddList>
void add_static_texel(const range_map<T>& map, std::size_t texel, static_receiver<T>& state, const AddList& add_list)
{
    if (!map.totals.empty()) {
        const range_total<T>& total = map.totals[texel];
        if (receiver_is_in_front(state.depth, total) > 0) return;
        if (static_receiver_is_behind(state, total) > 0) {
            state = static_receiver_add_total(state, total);
            return;
        }
    }
    add_list(map[texel]);
}

} // namespace detail

/// A receiver at rest at texel position (x, y), of resolved lists; add(state, range) is the shutter. A box asks totals
/// first, where the map has them.
template <class T, class Add = box_shutter>
T static_shadow(const range_map<T>& map, T x, T y, static_receiver<T> state, int look_ups = 1, const Add& add = {})
{
    const auto add_list = [&](std::span<const depth_time_range<T>> list) {
        detail::for_each_counted(list, state.id, [&](const depth_time_range<T>& r) { state = add(state, r); });
    };
    detail::for_each_static_texel(map, x, y, look_ups, [&](T weight, std::size_t texel) {
        state = static_receiver_weigh(state, weight);
        if constexpr (std::is_same_v<Add, box_shutter>) detail::add_static_texel(map, texel, state, add_list);
        else add_list(map[texel]);
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
        detail::for_each_texel(map, sweep.column, sweep.row, look_ups, [&](int i, int j, std::size_t texel) {
            const auto list = map[texel];
            if (list.empty()) return;
            state = moving_receiver_tap(state, sweep, T(i), T(j), k);
            detail::for_each_counted(list, path.depth.id, [&](const depth_time_range<T>& r) {
                if (r.t0 < sweep.t_end && sweep.t_begin < r.t1) state = add(state, r);
            });
        });
        if (!(sweep.t_end < sweep.path.depth.t1)) return moving_receiver_end(state);
    }
}

/// At one time; lists need not be resolved.
template <class T> T shadow_at(const range_map<T>& map, const receiver_path<T>& path, T t, T bias, int look_ups = 1)
{
    const T z = range_depth(path.depth, t);
    const texel_position<T> at = receiver_path_at(path, t);
    T shadow = 0;
    detail::for_each_static_texel(map, at.x, at.y, look_ups, [&](T weight, std::size_t texel) {
        T hidden = 0;
        for (const depth_time_range<T>& r : map[texel])
            hidden = std::max(hidden, range_intensity(r, t, z, path.depth.id, bias));
        shadow += weight * hidden;
    });
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
