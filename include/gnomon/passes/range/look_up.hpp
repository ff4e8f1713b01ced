// Shadow intensity of a receiver in a map of depth-time ranges, with percentage-closer filtering of K x K bilinear
// look-ups; K = 1 is bilinear filtering. At one time, by samples in time, and in closed form for a static or a moving
// receiver. The kernels are those of motion/; this is their loop over texels and lists. Outside of the map everything
// is lit. A map is a range_map, or any type with its members texel, operator[], prefetch_... and summaries, such as
// compact_range_map (compact.hpp). Closed forms need resolved lists in order of time. With a box shutter they read
// summaries first, if the map has them.
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

GNOMON_NAMESPACE_BEGIN

/// Shadow intensity of a static receiver at texel position (x, y), for a shutter as of shutters.hpp.
/// Error: static_receiver_end.
template <class Map, class T, class Shutter = box_shutter>
T static_intensity(const Map& map, T x, T y, static_receiver<T> state, int look_ups = 1, const Shutter& shutter = {})
{
    detail::expect_look_ups("static_intensity", look_ups);
    detail::for_each_static_texel(map, x, y, look_ups, [&](T weight, std::size_t texel) {
        state = static_receiver_set_weight(state, weight);
        if constexpr (std::is_same_v<Shutter, box_shutter>) {
            if (map.summaries.empty() || !detail::add_summary_box(state, map.summaries[texel]))
                detail::add_list_box(state, map[texel]);
        } else
            detail::for_each_counted(map[texel], state.id,
                                     [&](const depth_time_range<T>& r) { state = add_range(state, r, shutter); });
    });
    return static_receiver_end(state);
}

/// Shadow intensities of many static receivers, each as of static_intensity(map, x, y, state, look_ups), with taps read
/// many at a time. The bits are the same for a map without summaries; the order of sums differs with summaries, which
/// are added first.
template <class T, class Map>
void static_intensities(const Map& map, std::span<const placed_receiver<T>> receivers, std::span<T> shadows,
                        int look_ups = 1)
{
    GNOMON_EXPECTS(shadows.size() == receivers.size(), mismatch("static_intensities", "shadows.size()", shadows.size(),
                                                                "receivers.size()", receivers.size()));
    check_shape(map, "static_intensities");
    detail::expect_look_ups("static_intensities", look_ups);
    for (std::size_t i = 0; i < receivers.size(); ++i) shadows[i] = receivers[i].state.shadowed;
    detail::static_taps<T, Map> taps(map, receivers, shadows);
    for (std::size_t i = 0; i < receivers.size(); ++i)
        detail::for_each_static_texel(map, receivers[i].x, receivers[i].y, look_ups,
                                      [&](T weight, std::size_t texel) { taps.add(i, weight, texel); });
    taps.drain();
    for (T& s : shadows) s = saturate_or_zero(s);
}

/// Shadow intensity of a moving receiver from time t0 to time t1 of its path, in the exposure from begin to end.
/// Error: moving_receiver_end.
template <class Map, class T, class Shutter = box_shutter>
T moving_intensity(const Map& map, const receiver_path<T>& path, T begin, T end, int look_ups = 1,
                   const Shutter& shutter = {})
{
    detail::expect_look_ups("moving_intensity", look_ups);
    const T k = T(look_ups);
    const receiver_path<T> shifted = receiver_path_shift(path, T(-0.5) * k, T(-0.5) * k);
    texel_sweep<T> sweep = texel_sweep_over(shifted, -k, -k, T(map.width), T(map.height)); // outside of the map is lit
    if (!(sweep.t_begin < sweep.t_last)) return T(0);
    moving_receiver<T> state = moving_receiver_begin(path, begin, end);
    if constexpr (std::is_same_v<Shutter, box_shutter>) {
        detail::moving_taps<T, Map> taps(map, state, look_ups);
        texel_position<T> at = receiver_path_at(shifted, sweep.t_begin);
        T z = range_depth(path.depth, sweep.t_begin), passed = shutter_box(sweep.t_begin, state.begin, state.end);
        for (;; sweep = texel_sweep_next(sweep)) {
            if (sweep.t_begin < sweep.t_end) {
                const texel_position<T> next = receiver_path_at(shifted, sweep.t_end);
                const T next_z = range_depth(path.depth, sweep.t_end),
                        next_passed = shutter_box(sweep.t_end, state.begin, state.end);
                const T u0 = saturate_or_zero(at.x - sweep.column), u1 = saturate_or_zero(next.x - sweep.column);
                const T v0 = saturate_or_zero(at.y - sweep.row), v1 = saturate_or_zero(next.y - sweep.row);
                const detail::receiver_cell<T> cell{sweep.column,
                                                    sweep.row,
                                                    sweep.t_begin,
                                                    sweep.t_end,
                                                    u0,
                                                    v0,
                                                    u1,
                                                    v1,
                                                    (std::min)(z, next_z),
                                                    (std::max)(z, next_z),
                                                    next_passed - passed};
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
                    if (r.t0 < sweep.t_end && sweep.t_begin < r.t1) state = add_filtered_range(state, r, shutter);
                });
            });
            if (!(sweep.t_end < sweep.t_last)) return moving_receiver_end(state);
        }
    }
}

/// Shadow intensity at time t of a receiver on a path. Lists need not be resolved.
template <class Map, class T>
T intensity_at(const Map& map, const receiver_path<T>& path, T t, T bias, int look_ups = 1)
{
    detail::expect_look_ups("intensity_at", look_ups);
    const T z = range_depth(path.depth, t);
    const texel_position<T> at = receiver_path_at(path, t);
    T shadow = 0;
    detail::for_each_static_texel(map, at.x, at.y, look_ups, [&](T weight, std::size_t texel) {
        T hidden = 0;
        for (const depth_time_range<T>& r : map[texel])
            hidden = (std::max)(hidden, range_intensity(r, t, z, path.depth.id, bias));
        shadow += weight * hidden;
    });
    return saturate_or_zero(shadow);
}

/// Shadow intensity by n = max(2 |p_e - p_s|, 5) samples in time, at most `most`, in the middle of their strata.
/// Source: Palmer 2011, Sec. 4.1
template <class Map, class T>
T sampled_intensity(const Map& map, const receiver_path<T>& path, T bias, T most, int look_ups = 1)
{
    const T n = receiver_sample_count(path, most);
    sampled_receiver<T> state = sampled_receiver_begin(n);
    for (T k = 0; k < n; ++k)
        state = sampled_receiver_add(state,
                                     intensity_at(map, path, receiver_sample_time(path, k, n, T(0.5)), bias, look_ups));
    return sampled_receiver_end(state);
}

GNOMON_NAMESPACE_END
#endif
