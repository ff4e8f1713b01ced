#include "accumulation.hpp"

#include <gnomon/filters/percentage_closer.h>
#include <gnomon/motion/moving_receiver.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "light_receivers.hpp"
#include "toolbox/rasterizer.hpp"

namespace gnomon::demo {

using namespace toolbox;

accumulated_maps accumulate(const moving_scene& world, const moving_camera& light, int resolution, int count)
{
    accumulated_maps maps{resolution, std::vector<image<std::array<float, 1>>>(std::size_t(count))};
    for (std::size_t i = 0; i < maps.depths.size(); ++i)
        maps.depths[i] =
            rasterize_depth<1>(scene_at(world, maps.time(i)), light.at(double(maps.time(i))), resolution, resolution);
    return maps;
}

seen_motion seen_at_times(const seen_motion& seen, const accumulated_maps& maps)
{
    seen_motion result{seen.width, seen.height, {0}, {}};
    for (std::size_t pixel = 0; pixel + 1 < seen.first.size(); ++pixel) {
        for (std::size_t i = 0; i < maps.depths.size(); ++i) {
            const float t = maps.time(i);
            const auto courses = seen(pixel);
            const auto c = std::ranges::find_if(courses, [&](const seen_course& some) { return t < some.t1; });
            if (c == courses.end() || t < c->t0) continue;
            const float passed = (t - c->t0) / (c->t1 - c->t0);
            const glm::vec3 p = glm::mix(c->p0, c->p1, passed), n = glm::normalize(glm::mix(c->n0, c->n1, passed));
            result.courses.push_back({t, t, 1 / float(maps.depths.size()), c->triangle, p, p, n, n});
        }
        result.first.push_back(std::uint32_t(result.courses.size()));
    }
    return result;
}

std::vector<float> accumulated_visibility(const seen_motion& at_times, const moving_camera& light,
                                          const accumulated_maps& maps)
{
    const std::vector<light_receiver> receivers = light_receivers_of(at_times, light, maps.resolution);
    std::vector<float> result(receivers.size());
    for (std::size_t i = 0; i < result.size(); ++i) {
        const light_receiver& r = receivers[i];
        if (!(r.facing.begin < r.facing.end)) continue;
        const float t = r.path.depth.t0;
        const auto& depths = maps.depths[std::size_t(t * float(maps.depths.size()))];
        const texel_position<float> at = receiver_path_at(r.path, t);
        // Nothing in a map is depth 1, and in front of nothing.
        auto state = percentage_closer_begin(std::min(r.path.depth.z0, 1.f));
        for_each_tap(at, [&](float column, float row, float weight) {
            const bool inside = column >= 0 && row >= 0 && column < float(depths.width) && row < float(depths.height);
            state = percentage_closer_add(state, inside ? depths(int(column), int(row))[0] : 1.f, weight);
        });
        result[i] = 1 - percentage_closer_end(state);
    }
    return result;
}

} // namespace gnomon::demo
