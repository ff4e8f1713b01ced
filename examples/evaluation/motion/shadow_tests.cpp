#include "shadow_tests.hpp"

#include <gnomon/motion/range/range_cover.h>
#include <gnomon/passes/range/look_up.hpp>

#include <algorithm>

namespace gnomon::evaluation {

namespace {

constexpr float most_samples = 256;

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

// In closed form where it is at time t, with its own line of depth.
float path_visibility_in_place(const range_map<float>& map, receiver_path<float> path, float t)
{
    const texel_position<float> at = receiver_path_at(path, t);
    path.x0 = path.x1 = at.x, path.y0 = path.y1 = at.y, path.w0 = path.w1 = 1;
    return 1 - moving_intensity(map, path, path.depth.t0, path.depth.t1);
}

float path_visibility(const range_map<float>& map, const receiver_path<float>& path, int look_ups)
{
    if (path.depth.z0 != path.depth.z1 || receiver_path_length(path) > 1e-4f)
        return 1 - moving_intensity(map, path, path.depth.t0, path.depth.t1, look_ups);
    const texel_position<float> at = receiver_path_at(path, path.depth.t0);
    return 1 - static_intensity(map, at.x, at.y,
                                static_receiver_begin(path.depth.z0, path.depth.id, path.depth.t0, path.depth.t1),
                                look_ups);
}

float path_visibility_sampled(const range_map<float>& map, const receiver_path<float>& path)
{
    return 1 - sampled_intensity(map, path, 0.f, most_samples);
}

bool in_one_texel(const receiver_path<float>& path)
{
    const texel_position<float> open = receiver_path_at(path, path.depth.t0),
                                close = receiver_path_at(path, path.depth.t1);
    return texel_below(open.x) == texel_below(close.x) && texel_below(open.y) == texel_below(close.y);
}

bool faces_at(const light_receiver& r, float t)
{
    const float passed = range_elapsed(r.path.depth, t);
    return r.facing.begin <= passed && passed <= r.facing.end &&
           !(r.facing.gap_begin < passed && passed < r.facing.gap_end);
}

} // namespace

float visibility_at(const range_map<float>& map, const light_receiver& r, float t)
{
    return faces_at(r, t) ? 1 - intensity_at(map, r.path, t, 0.f) : 0;
}

float cover_first_visibility_at(const range_shadow_map& map, const light_receiver& r, float t)
{
    if (!faces_at(r, t)) return 0;
    const float z = range_depth(r.path.depth, t), id = r.path.depth.id, size = float(map.resolution);
    float shadow = 0;
    for_each_tap(receiver_path_at(r.path, t), [&](float column, float row, float weight) {
        if (!(column >= 0 && row >= 0 && column < size && row < size)) return;
        const std::size_t texel =
            range_map<float>::texel(std::size_t(map.resolution), std::size_t(column), std::size_t(row));
        const cover_answer<float> answer = range_cover_answer(map.texel_covers[texel], t, z, id, 0.f);
        float hidden = answer.intensity;
        if (answer.decided == 0)
            for (const auto& range : list_of(map, texel))
                hidden = std::max(hidden, range_intensity(range, t, z, id, 0.f));
        shadow += weight * hidden;
    });
    return 1 - saturate_or_zero(shadow);
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

float light_visibility(const range_map<float>& map, const light_receiver& r)
{
    return while_facing(r, [&](const receiver_path<float>& path) { return path_visibility(map, path, 1); });
}

float wide_visibility(const range_map<float>& map, const light_receiver& r)
{
    return while_facing(r, [&](const receiver_path<float>& path) { return path_visibility(map, path, 3); });
}

} // namespace gnomon::evaluation
