#include "line_maps.hpp"

#include <gnomon/passes/range/look_up.hpp>

#include <algorithm>
#include <utility>

namespace gnomon::evaluation {

using namespace renderer;

std::size_t line_maps::bytes() const
{
    std::size_t sum = 0;
    for (const auto* maps : {&along_x, &along_y})
        for (const range_lists& one : *maps) sum += one.bytes();
    return sum;
}

line_maps rasterize_lines(const moving_scene& world, const moving_camera& light, int resolution,
                          std::vector<float> times, line_look_up how)
{
    line_maps result{resolution, std::move(times), {}, {}};
    range_rasterizer rasterize;
    for (std::size_t k = 0; k < result.times.size(); ++k) {
        const auto add = [&](std::vector<range_lists>& to, bool reads, double x, double y) {
            to.emplace_back();
            if (reads)
                to.back() = rasterize(world, light, resolution, resolution,
                                      {.resolved = true,
                                       .depth_tolerance = depth_tolerance,
                                       .line = line_sample<double>{double(result.times[k]), x, y}});
        };
        add(result.along_x, how == line_look_up::crossed || k % 2 == 0, 1, 0);
        add(result.along_y, how == line_look_up::crossed || k % 2 == 1, 0, 1);
    }
    return result;
}

line_receivers line_receivers_of(const seen_motion& at_times, const moving_camera& light, const line_maps& maps)
{
    const std::vector<light_receiver> all = light_receivers_of(at_times, light, maps.resolution);
    line_receivers result;
    for (const float t : maps.times) {
        for (std::size_t i = 0; i < all.size(); ++i) {
            const receiver_path<float>& path = all[i].path;
            if (path.depth.t0 < t || t < path.depth.t0 || !(all[i].facing.begin < all[i].facing.end)) continue;
            const texel_position<float> at = receiver_path_at(path, t);
            result.where.push_back({at.x, at.y, path.depth.z0, path.depth.id});
            result.segments.push_back(std::uint32_t(i));
        }
        result.ends.push_back(result.where.size());
    }
    return result;
}

void line_visibility(const line_maps& maps, const line_receivers& receivers, line_look_up how,
                     std::span<float> of_segments)
{
    std::size_t i = 0;
    for (std::size_t k = 0; k < maps.times.size(); ++k) {
        const range_map<float> x = maps.along_x[k].map(), y = maps.along_y[k].map();
        const auto look_up = [&](const line_receiver<float>& r) {
            if (how == line_look_up::crossed) return crossed_intensity(x, y, r);
            if (how == line_look_up::placed)
                return k % 2 == 0 ? line_intensity(x, line_axis::x, r) : line_intensity(y, line_axis::y, r);
            return static_intensity(k % 2 == 0 ? x : y, r.x, r.y, static_receiver_begin(r.z, r.id, 0.f, 1.f));
        };
        for (; i < receivers.ends[k]; ++i) of_segments[receivers.segments[i]] = 1 - look_up(receivers.where[i]);
    }
}

} // namespace gnomon::evaluation
