#include "analytic.hpp"

#include "range_receiver.hpp"
#include "while_facing.hpp"

namespace gnomon::evaluation {

namespace {

float path_visibility(const range_map<float>& map, const receiver_path<float>& path, int look_ups)
{
    if (path.depth.z0 != path.depth.z1 || receiver_path_length(path) > 1e-4f)
        return 1 - moving_intensity(map, path, path.depth.t0, path.depth.t1, look_ups);
    const texel_position<float> at = receiver_path_at(path, path.depth.t0);
    return 1 - static_intensity(map, at.x, at.y,
                                static_receiver_begin(path.depth.z0, path.depth.id, path.depth.t0, path.depth.t1),
                                look_ups);
}

} // namespace

float light_visibility(const range_map<float>& map, const light_receiver& r)
{
    return while_facing(r, [&](const receiver_path<float>& path) { return path_visibility(map, path, 1); });
}

float wide_visibility(const range_map<float>& map, const light_receiver& r)
{
    return while_facing(r, [&](const receiver_path<float>& path) { return path_visibility(map, path, 3); });
}

namespace {

const registered<receiver_by<light_visibility>> entry{
    receiver_facts{.id = "analytic", .label = "analytic receivers", .order = 150, .marker = "triangle"}, false};

} // namespace

} // namespace gnomon::evaluation
