#include "light_receivers.hpp"

#include "renderer/shade/receivers.hpp"

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <tbb/parallel_for.h>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

// Of floats that depth and time went through, over the range of depths.
constexpr double rounding_bias = 4e-6;

struct end {
    glm::vec4 place; // x w, y w, biased depth, w
    glm::dvec3 to_light;
};

end end_of(const camera& light, int resolution, double radius, const glm::vec3& position, const glm::vec3& normal)
{
    const glm::dvec3 p(position), n(normal);
    glm::dvec4 place = texel_space(light, glm::dvec2(resolution), p);
    place.z -= radius * plane_slope(p, n, light, resolution) + rounding_bias;
    return {glm::vec4(place), light.perspective() ? light.position - p : -light.forward};
}

light_receiver receiver_of(const seen_segment& c, const moving_camera& light, int resolution, double radius)
{
    const end open = end_of(light.at(double(c.t0)), resolution, radius, c.p0, c.n0);
    const end close = end_of(light.at(double(c.t1)), resolution, radius, c.p1, c.n1);
    const glm::vec3 d0(open.to_light), d1(close.to_light);
    const moving_vector<float> normal{c.n0.x, c.n0.y, c.n0.z, c.n1.x, c.n1.y, c.n1.z};
    const moving_vector<float> direction{d0.x, d0.y, d0.z, d1.x, d1.y, d1.z};
    return {{{c.t0, c.t1, open.place.z, close.place.z, float(c.triangle)},
             open.place.x,
             open.place.y,
             open.place.w,
             close.place.x,
             close.place.y,
             close.place.w},
            moving_edge_inside(facing_function(normal, direction), 1.f),
            glm::dot(glm::normalize(d0), c.n0),
            glm::dot(glm::normalize(d1), c.n1)};
}

} // namespace

std::vector<light_receiver> light_receivers_of(const seen_motion& seen, const moving_camera& light, int resolution,
                                               double radius)
{
    std::vector<light_receiver> result(seen.segments.size());
    tbb::parallel_for(std::size_t(0), result.size(),
                      [&](std::size_t i) { result[i] = receiver_of(seen.segments[i], light, resolution, radius); });
    return result;
}

void set_ids(std::span<light_receiver> receivers, std::span<const std::uint32_t> id_of_triangle)
{
    for (light_receiver& r : receivers) r.path.depth.id = float(id_of_triangle[std::size_t(r.path.depth.id)]);
}

} // namespace gnomon::evaluation
