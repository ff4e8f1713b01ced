#include "shadow_tests.hpp"

#include <gnomon/motion/moving_receiver.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace gnomon::demo {

namespace {

std::span<const depth_time_range<float>> list_at(const range_map<float>& map, float column, float row)
{
    const bool inside = column >= 0 && row >= 0 && column < float(map.width) && row < float(map.height);
    return inside ? map(std::size_t(column), std::size_t(row)) : std::span<const depth_time_range<float>>();
}

// The up to two parts of its time in which it faces the light, calling lit(path) for each; the sum of their shares.
template <class Visibility> float while_facing(const light_receiver& r, const Visibility& lit)
{
    const float begin = r.path.depth.t0, duration = range_duration(r.path.depth);
    if (!(duration > 0)) return r.facing.begin < r.facing.end ? lit(r.path) : 0;
    const auto part = [&](float from, float to) {
        if (!(from < to)) return 0.f;
        if (from <= 0 && to >= 1) return lit(r.path);
        return (to - from) * lit(receiver_path_clip(r.path, begin + from * duration, begin + to * duration));
    };
    return std::min(part(r.facing.begin, std::min(r.facing.end, r.facing.gap_begin)) +
                        part(std::max(r.facing.begin, r.facing.gap_end), r.facing.end),
                    1.f);
}

float path_visibility_at(const range_map<float>& map, const receiver_path<float>& path, float t)
{
    const float z = range_depth(path.depth, t);
    float shadow = 0;
    for_each_tap(receiver_path_at(path, t), [&](float column, float row, float weight) {
        float hidden = 0;
        for (const depth_time_range<float>& r : list_at(map, column, row))
            hidden = std::max(hidden, range_intensity(r, t, z, path.depth.id, 0.f));
        shadow += weight * hidden;
    });
    return 1 - std::min(shadow, 1.f);
}

float path_visibility_sampled(const range_map<float>& map, const receiver_path<float>& path)
{
    const float n = receiver_sample_count(path, 256.f);
    sampled_receiver<float> state = sampled_receiver_begin(n);
    for (float k = 0; k < n; ++k)
        state = sampled_receiver_add(state, 1 - path_visibility_at(map, path, receiver_sample_time(path, k, n, 0.5f)));
    return 1 - sampled_receiver_end(state);
}

// In closed form where it is at time t, with its own course of depth.
float path_visibility_in_place(const range_map<float>& map, const receiver_path<float>& path, float t)
{
    moving_receiver<float> state = moving_receiver_begin(path, path.depth.t0, path.depth.t1);
    for_each_tap(receiver_path_at(path, t), [&](float column, float row, float weight) {
        state.u0 = state.u1 = weight;
        for (const depth_time_range<float>& r : list_at(map, column, row)) state = moving_receiver_filter_box(state, r);
    });
    return 1 - moving_receiver_end(state);
}

float path_visibility_at_rest(const range_map<float>& map, const receiver_path<float>& path)
{
    static_receiver<float> state = static_receiver_begin(path.depth.z0, path.depth.id, path.depth.t0, path.depth.t1);
    for_each_tap(receiver_path_at(path, path.depth.t0), [&](float column, float row, float weight) {
        state = static_receiver_weigh(state, weight);
        for (const depth_time_range<float>& r : list_at(map, column, row)) state = static_receiver_add_box(state, r);
    });
    return 1 - static_receiver_end(state);
}

float path_visibility(const range_map<float>& map, const receiver_path<float>& path)
{
    if (receiver_path_length(path) < 1e-4f)
        return path.depth.z0 == path.depth.z1 ? path_visibility_at_rest(map, path)
                                              : path_visibility_in_place(map, path, path.depth.t0);
    moving_receiver<float> state = moving_receiver_begin(path, path.depth.t0, path.depth.t1);
    texel_sweep<float> sweep = texel_sweep_begin(receiver_path_shifted(path, -0.5f, -0.5f));
    for (;; sweep = texel_sweep_next(sweep)) {
        for (const float j : {0.f, 1.f})
            for (const float i : {0.f, 1.f}) {
                state = moving_receiver_tap(state, sweep, i, j, 1.f);
                for (const depth_time_range<float>& r : list_at(map, sweep.column + i, sweep.row + j))
                    state = moving_receiver_filter_box(state, r);
            }
        if (!(sweep.t_end < path.depth.t1)) break;
    }
    return 1 - moving_receiver_end(state);
}

bool in_one_texel(const receiver_path<float>& path)
{
    const texel_position<float> open = receiver_path_at(path, path.depth.t0),
                                close = receiver_path_at(path, path.depth.t1);
    return texel_below(open.x) == texel_below(close.x) && texel_below(open.y) == texel_below(close.y);
}

} // namespace

float visibility_at(const range_map<float>& map, const light_receiver& r, float t)
{
    const float passed = range_passed(r.path.depth, t);
    const bool faces = r.facing.begin <= passed && passed <= r.facing.end &&
                       !(r.facing.gap_begin < passed && passed < r.facing.gap_end);
    return faces ? path_visibility_at(map, r.path, t) : 0;
}

float sampled_visibility(const range_map<float>& map, const light_receiver& r)
{
    return while_facing(r, [&](const receiver_path<float>& path) { return path_visibility_sampled(map, path); });
}

float resting_visibility(const range_map<float>& map, const light_receiver& r)
{
    return while_facing(r, [&](receiver_path<float> path) {
        const float t = 0.5f * (path.depth.t0 + path.depth.t1);
        path.depth.z0 = path.depth.z1 = range_depth(path.depth, t);
        return path_visibility_in_place(map, path, t);
    });
}

float semi_analytic_visibility(const range_map<float>& map, const light_receiver& r)
{
    return while_facing(r, [&](const receiver_path<float>& path) {
        return in_one_texel(path) ? path_visibility_in_place(map, path, path.depth.t0)
                                  : path_visibility_sampled(map, path);
    });
}

float analytic_visibility(const range_map<float>& map, const light_receiver& r)
{
    return while_facing(r, [&](const receiver_path<float>& path) { return path_visibility(map, path); });
}

} // namespace gnomon::demo
