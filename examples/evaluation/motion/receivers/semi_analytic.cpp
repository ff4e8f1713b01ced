// As in Palmer 2011: in closed form where both ends of the path are in one texel, by samples elsewhere. The lists of the
// map are resolved.
#include "range_receiver.hpp"
#include "while_facing.hpp"

namespace gnomon::evaluation {

namespace {

bool in_one_texel(const receiver_path<float>& path)
{
    const texel_position<float> open = receiver_path_at(path, path.depth.t0),
                                close = receiver_path_at(path, path.depth.t1);
    return texel_below(open.x) == texel_below(close.x) && texel_below(open.y) == texel_below(close.y);
}

float semi_analytic_visibility(const range_map<float>& map, const light_receiver& r)
{
    return while_facing(r, [&](const receiver_path<float>& path) {
        return in_one_texel(path) ? visibility_in_place(map, path, path.depth.t0) : sampled_path_visibility(map, path);
    });
}

const registered<receiver_by<semi_analytic_visibility>> entry{
    receiver_facts{.id = "semi_analytic", .label = "semi-analytic receivers", .order = 140, .marker = "diamond"},
    false};

} // namespace

} // namespace gnomon::evaluation
