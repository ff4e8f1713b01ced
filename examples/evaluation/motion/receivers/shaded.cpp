#include "shaded.hpp"

#include "range_receiver.hpp"
#include "while_facing.hpp"

#include <algorithm>

namespace gnomon::evaluation {

float shaded_visibility(const range_map<float>& map, const light_receiver& r)
{
    const float open = std::max(r.cosine_open, 0.f), close = std::max(r.cosine_close, 0.f);
    if (!(open + close > 0)) return 0;
    const depth_time_range<float>& times = r.path.depth;
    return while_facing(r, [&](const receiver_path<float>& path) {
        // Where the receiver begins or ends to face the light, the cosine is 0.
        const float first = path.depth.t0 > times.t0 ? 0 : open, last = path.depth.t1 < times.t1 ? 0 : close;
        const linear_shutter<float> light{first, last};
        const float lit = 1 - moving_intensity(map, path, path.depth.t0, path.depth.t1, 1, light);
        return lit * (first + last) / (open + close);
    });
}

namespace {

const registered<receiver_by<shaded_visibility>> entry{
    receiver_facts{.id = "shaded", .label = "analytic receivers in changing light", .order = 155, .marker = "down"},
    false};

} // namespace

} // namespace gnomon::evaluation
