// Receivers as if they were static, at their place and depth halfway. The lists of the map are resolved.
#include "range_receiver.hpp"
#include "while_facing.hpp"

namespace gnomon::evaluation {

namespace {

float static_visibility(const range_map<float>& map, const light_receiver& r)
{
    return while_facing(r, [&](receiver_path<float> path) {
        const float t = 0.5f * (path.depth.t0 + path.depth.t1);
        path.depth.z0 = path.depth.z1 = range_depth(path.depth, t);
        return visibility_in_place(map, path, t);
    });
}

const registered<receiver_by<static_visibility>> entry{
    receiver_facts{.id = "static", .label = "receivers taken as static", .order = 120, .marker = "cross"}, false};

} // namespace

} // namespace gnomon::evaluation
