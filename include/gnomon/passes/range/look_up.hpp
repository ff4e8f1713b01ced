// The shadow that a receiver gets from a map of depth-time ranges, with percentage-closer filtering of K x K bilinear
// look-ups: K = 1 is bilinear filtering. At one time, by samples in time, at rest in closed form, and on its way in
// closed form; the kernels are those of motion/, this is their loop over texels and lists. Shadow intensity, 0 lit and
// 1 in shadow. All that lies outside of the map is lit. Closed forms are of resolved lists in order of time; a shutter
// that opens and closes at once asks totals first, where the map has them.
#ifndef GNOMON_PASSES_RANGE_LOOK_UP_HPP
#define GNOMON_PASSES_RANGE_LOOK_UP_HPP

#include "../../motion/receiver/moving_receiver.h"
#include "../../motion/receiver/receiver_path.h"
#include "../../motion/receiver/static_receiver.h"
#include "map.hpp"
#include "taps.hpp"

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

/// A receiver at rest at texel position (x, y); add(state, range) is the shutter.
template <class T, class Add = box_shutter>
T static_intensity(const range_map<T>& map, T x, T y, static_receiver<T> state, int look_ups = 1, const Add& add = {})
{
    detail::for_each_static_texel(map, x, y, look_ups, [&](T weight, std::size_t texel) {
        state = static_receiver_set_weight(state, weight);
        if constexpr (std::is_same_v<Add, box_shutter>) {
            if (map.summaries.empty() || !detail::add_total_box(state, map.summaries[texel]))
                detail::add_list_box(state, map[texel]);
        } else
            detail::for_each_counted(map[texel], state.id,
                                     [&](const depth_time_range<T>& r) { state = add(state, r); });
    });
    return static_receiver_end(state);
}

/// static_intensity(map, x, y, state, look_ups) of each receiver, whose taps are read many at a time. Without totals it
/// has the same bits; what totals say is added first.
template <class T>
void static_intensities(const range_map<T>& map, std::span<const placed_receiver<T>> receivers, std::span<T> shadows,
                        int look_ups = 1)
{
    GNOMON_EXPECTS(shadows.size() == receivers.size(), mismatch("static_intensities", "shadows.size()", shadows.size(),
                                                                "receivers.size()", receivers.size()));
    check_shape(map, "static_intensities");
    for (std::size_t i = 0; i < receivers.size(); ++i) shadows[i] = receivers[i].state.shadowed;
    detail::static_taps<T> taps(map, receivers, shadows);
    for (std::size_t i = 0; i < receivers.size(); ++i)
        detail::for_each_static_texel(map, receivers[i].x, receivers[i].y, look_ups,
                                      [&](T weight, std::size_t texel) { taps.add(i, weight, texel); });
    taps.drain();
    for (T& s : shadows) s = saturate_or_zero(s);
}

/// A receiver on its way from time t0 to t1 of the path, in the exposure from begin to end. Error: moving_receiver_end.
template <class T, class Add = box_shutter>
T moving_intensity(const range_map<T>& map, const receiver_path<T>& path, T begin, T end, int look_ups = 1,
                   const Add& add = {})
{
    const T k = T(look_ups);
    const receiver_path<T> shifted = receiver_path_shift(path, T(-0.5) * k, T(-0.5) * k);
    texel_sweep<T> sweep = texel_sweep_over(shifted, -k, -k, T(map.width), T(map.height)); // beyond is lit
    if (!(sweep.t_begin < sweep.t_last)) return T(0);
    moving_receiver<T> state = moving_receiver_begin(path, begin, end);
    if constexpr (std::is_same_v<Add, box_shutter>) {
        detail::moving_taps<T> taps(map, state, look_ups);
        texel_position<T> at = receiver_path_at(shifted, sweep.t_begin);
        T z = range_depth(path.depth, sweep.t_begin), passed = shutter_box(sweep.t_begin, state.begin, state.end);
        for (;; sweep = texel_sweep_next(sweep)) {
            if (sweep.t_begin < sweep.t_end) {
                const texel_position<T> next = receiver_path_at(shifted, sweep.t_end);
                const T next_z = range_depth(path.depth, sweep.t_end),
                        next_passed = shutter_box(sweep.t_end, state.begin, state.end);
                const T u0 = saturate_or_zero(at.x - sweep.column), u1 = saturate_or_zero(next.x - sweep.column);
                const T v0 = saturate_or_zero(at.y - sweep.row), v1 = saturate_or_zero(next.y - sweep.row);
                const detail::receiver_cell<T> cell{
                    sweep.column, sweep.row,           sweep.t_begin,       sweep.t_end,         u0, v0, u1,
                    v1,           std::min(z, next_z), std::max(z, next_z), next_passed - passed};
                if (cell.share > 0) taps.add(cell); // the shutter is open
                at = next, z = next_z, passed = next_passed;
            }
            if (!(sweep.t_end < sweep.t_last)) return taps.end();
        }
    } else {
        for (;; sweep = texel_sweep_next(sweep)) {
            detail::for_each_texel(map, sweep.column, sweep.row, look_ups, [&](int i, int j, std::size_t texel) {
                if (map[texel].empty()) return;
                state = moving_receiver_tap(state, sweep, T(i), T(j), k);
                detail::for_each_counted(map[texel], path.depth.id, [&](const depth_time_range<T>& r) {
                    if (r.t0 < sweep.t_end && sweep.t_begin < r.t1) state = add(state, r);
                });
            });
            if (!(sweep.t_end < sweep.t_last)) return moving_receiver_end(state);
        }
    }
}

/// At one time; lists need not be resolved.
template <class T> T intensity_at(const range_map<T>& map, const receiver_path<T>& path, T t, T bias, int look_ups = 1)
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
T sampled_intensity(const range_map<T>& map, const receiver_path<T>& path, T bias, T most, int look_ups = 1)
{
    const T n = receiver_sample_count(path, most);
    sampled_receiver<T> state = sampled_receiver_begin(n);
    for (T k = 0; k < n; ++k)
        state = sampled_receiver_add(state,
                                     intensity_at(map, path, receiver_sample_time(path, k, n, T(0.5)), bias, look_ups));
    return sampled_receiver_end(state);
}

} // namespace gnomon
#endif
