// Shadow intensity of a receiver in a map of depth-time ranges with opacities (range_transmittance.h), with
// percentage-closer filtering of K x K bilinear look-ups. Lists need neither order nor a resolve. Outside of the map
// everything is lit.
#ifndef GNOMON_PASSES_RANGE_TRANSLUCENT_HPP
#define GNOMON_PASSES_RANGE_TRANSLUCENT_HPP

#include "../../motion/range/range_transmittance.h"
#include "taps.hpp"

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

GNOMON_NAMESPACE_BEGIN

/// A map of ranges, and the opacity of each of them.
template <class T> struct translucent_range_map {
    range_map<T> lists;
    std::span<const T> opacities;
};

template <class T> void check_shape(const translucent_range_map<T>& map, std::string_view pass)
{
    check_shape(map.lists, pass);
    GNOMON_EXPECTS(map.opacities.size() == map.lists.ranges.size(),
                   mismatch(pass, "map.opacities.size()", map.opacities.size(), "map.lists.ranges.size()",
                            map.lists.ranges.size()));
}

namespace detail {

/// Call visit(step) for each step of transmittance of a texel's list, from time begin to time end, for a receiver with
/// this id. part(range) is the part of a range in front of the receiver.
template <class T, class Part, class Visit>
void for_each_step(const translucent_range_map<T>& map, std::size_t texel, T id, T begin, T end, const Part& part,
                   const Visit& visit)
{
    const std::span<const depth_time_range<T>> list = map.lists[texel];
    const T* const opacities = map.opacities.data() + map.lists.first[texel];
    const auto steps = [&](const auto& add_all) {
        for (T t = begin; t < end;) {
            const range_transmittance<T> step = add_all(range_transmittance_begin(t, end));
            visit(step);
            t = step.t1;
        }
    };
    // The parts of most lists fit into few lines of memory. For others they are computed again in each step.
    constexpr std::size_t room = 32;
    std::array<depth_time_range<T>, room> parts;
    std::array<T, room> opacity;
    std::size_t count = 0;
    bool fits = true;
    for (std::size_t i = 0; i < list.size() && fits; ++i) {
        const depth_time_range<T> hidden = part(list[i]);
        if (!(hidden.t0 < hidden.t1) || hidden.id == id) continue;
        fits = count < room;
        if (fits) parts[count] = hidden, opacity[count++] = opacities[i];
    }
    if (count == 0) return;
    if (fits)
        steps([&](range_transmittance<T> step) {
            for (std::size_t i = 0; i < count; ++i) step = range_transmittance_add(step, parts[i], id, opacity[i]);
            return step;
        });
    else
        steps([&](range_transmittance<T> step) {
            for (std::size_t i = 0; i < list.size(); ++i)
                step = range_transmittance_add(step, part(list[i]), id, opacities[i]);
            return step;
        });
}

} // namespace detail

/// Shadow intensity of a static receiver at texel position (x, y): the mean opacity of what is in front of it, for a
/// shutter as of shutters.hpp.
/// Error: that of static_receiver_end for each step, and that of range_transmittance_add.
template <class T, class Shutter = box_shutter>
T static_intensity(const translucent_range_map<T>& map, T x, T y, static_receiver<T> state, int look_ups = 1,
                   const Shutter& shutter = {})
{
    detail::expect_look_ups("static_intensity", look_ups);
    detail::for_each_static_texel(map.lists, x, y, look_ups, [&](T weight, std::size_t texel) {
        state = static_receiver_set_weight(state, weight);
        detail::for_each_step(
            map, texel, state.id, state.begin, state.end,
            [&](const depth_time_range<T>& r) { return static_receiver_occluding_part(state, r); },
            [&](const range_transmittance<T>& step) {
                const T share0 = shutter.share(step.t0, state.begin, state.end);
                const T share1 = shutter.share(step.t1, state.begin, state.end);
                state = static_receiver_add(state, range_transmittance_lost(step, share0, share1));
            });
    });
    return static_receiver_end(state);
}

/// Shadow intensity of a moving receiver from time t0 to time t1 of its path, in the exposure from begin to end.
/// Error: that of moving_receiver_end for each step, and that of range_transmittance_add.
template <class T, class Shutter = box_shutter>
T moving_intensity(const translucent_range_map<T>& map, const receiver_path<T>& path, T begin, T end, int look_ups = 1,
                   const Shutter& shutter = {})
{
    detail::expect_look_ups("moving_intensity", look_ups);
    const T k = T(look_ups);
    const receiver_path<T> shifted = receiver_path_shift(path, T(-0.5) * k, T(-0.5) * k);
    texel_sweep<T> sweep = texel_sweep_over(shifted, -k, -k, T(map.lists.width), T(map.lists.height));
    if (!(sweep.t_begin < sweep.t_last)) return T(0);
    moving_receiver<T> state = moving_receiver_begin(path, begin, end);
    for (;; sweep = texel_sweep_next(sweep)) {
        detail::for_each_texel(map.lists, sweep.column, sweep.row, look_ups, [&](int i, int j, std::size_t texel) {
            if (map.lists[texel].empty()) return;
            state = moving_receiver_tap(state, sweep, T(i), T(j), k);
            detail::for_each_step(
                map, texel, path.depth.id, sweep.t_begin, sweep.t_end,
                [&](const depth_time_range<T>& r) { return moving_receiver_occluding_part(state, r); },
                [&](const range_transmittance<T>& step) {
                    const depth_time_range<T> during{step.t0, step.t1, T(0), T(0), T(range_nothing)};
                    const T light = shutter.filtered_light(state, during);
                    state = moving_receiver_add(state, light * range_transmittance_lost(step, T(0), T(1)));
                });
        });
        if (!(sweep.t_end < sweep.t_last)) return moving_receiver_end(state);
    }
}

GNOMON_NAMESPACE_END
#endif
