// How do shadows look when everything moves while the shutter is open?
//
// The light renders a map of depth-time ranges, a list for each texel. The camera renders what each pixel sees from
// when to when. Each such segment is a moving receiver, as in lesson 6, which this map answers in closed form: no
// noise.
#include "renderer/raster/moving_rasterizer.hpp"
#include "renderer/scene/moving_stages.hpp"
#include "renderer/shade/moving_view.hpp"
#include "renderer/shade/receivers.hpp"

#include <gnomon/passes/range/look_up.hpp>

#include <glm/vec4.hpp>

#include <cstdio>
#include <vector>

using namespace gnomon::renderer;

constexpr int width = 960, height = 540, side = 512;
constexpr float tolerance = 0.001f; // of depth: a curve becomes several lines that depart from it by less

// The path of a segment over the light's map: position in texels and depth at both ends, in front of its own surface.
gnomon::receiver_path<float> path_of(const seen_segment& segment, const moving_camera& light)
{
    const auto end = [&](float t, const glm::vec3& position, const glm::vec3& normal) {
        const camera at = light.at(double(t));
        glm::dvec4 place = texel_space(at, glm::dvec2(side), position); // x w, y w, depth, w
        place.z -= 1.5 * plane_slope(position, normal, at, side);       // as far as the look-up reaches, in texels
        place.z -= 4e-6;                                                // rounding to float
        return glm::vec4(place);
    };
    const glm::vec4 a = end(segment.t0, segment.p0, segment.n0), b = end(segment.t1, segment.p1, segment.n1);
    return {{segment.t0, segment.t1, a.z, b.z, float(segment.triangle)}, a.x, a.y, a.w, b.x, b.y, b.w};
}

int main()
{
    const moving_stage scenery = random_cubes(double(width) / height, 24, 1.0f); // each in a direction of its own

    // 1. The light's map. Resolved lists hold the ranges in front, without overlaps, in order of time.
    range_rasterizer rasterize;
    const range_lists& lists =
        rasterize(scenery.world, scenery.light, side, side, {.resolved = true, .depth_tolerance = tolerance});
    std::printf("%zu ranges in %d x %d texels\n", lists.ranges.size(), side, side);

    // 2. The segments of each pixel of the camera: a triangle, from when to when, and the path of a point on it.
    const seen_motion seen = camera_segments(scenery.world, scenery.eye, width, height, tolerance);

    // 3. The look-up of each segment, averaged over its own time.
    std::vector<float> visibility;
    for (const seen_segment& segment : seen.segments) {
        const auto path = path_of(segment, scenery.light);
        visibility.push_back(1 - gnomon::moving_intensity(lists.map(), path, segment.t0, segment.t1));
    }
    write_png("out/lessons/07_map_of_ranges.png", shade(scenery.world, scenery.light, seen, visibility));
}
