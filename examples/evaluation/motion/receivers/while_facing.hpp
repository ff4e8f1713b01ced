// Parts that kinds of receivers share: the times at which a path faces the light, and its visibility by samples or as if
// it were static.
#pragma once

#include "evaluation/motion/light_receivers.hpp"

#include <gnomon/passes/range/look_up.hpp>

#include <algorithm>

namespace gnomon::evaluation {

// The sum of lit(path) over the up to two parts of its time in which the receiver faces the light, by their shares.
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

// In closed form at the place of time t, with the path's own depths.
inline float visibility_in_place(const range_map<float>& map, receiver_path<float> path, float t)
{
    const texel_position<float> at = receiver_path_at(path, t);
    path.x0 = path.x1 = at.x, path.y0 = path.y1 = at.y, path.w0 = path.w1 = 1;
    return 1 - moving_intensity(map, path, path.depth.t0, path.depth.t1);
}

// By n = max(2 |p_e - p_s|, 5) samples in the middle of their strata (Palmer 2011, 4.1).
inline float sampled_path_visibility(const range_map<float>& map, const receiver_path<float>& path)
{
    constexpr float most_samples = 256;
    return 1 - sampled_intensity(map, path, 0.f, most_samples);
}

} // namespace gnomon::evaluation
