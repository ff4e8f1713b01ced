#include "moving_stage_builder.hpp"

#include "paint.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace gnomon::renderer {

namespace {

std::vector<glm::vec3> positions_at(const moving_scene& world, bool closing)
{
    std::vector<glm::vec3> result;
    for (std::size_t m = 0; m < world.closing.size(); ++m) {
        const auto& positions = closing ? world.closing[m] : world.open.meshes[m].positions;
        result.insert(result.end(), positions.begin(), positions.end());
    }
    return result;
}

} // namespace

void add(moving_scene& world, const mesh& open, const mesh& closing)
{
    world.open.meshes.push_back(open);
    world.closing.push_back(closing.positions);
}

void add(moving_scene& world, const mesh& open, const glm::vec3& motion)
{
    mesh closing = open;
    for (glm::vec3& position : closing.positions) position += motion;
    add(world, open, closing);
}

moving_camera spot_light(const moving_scene& casters, const moving_scene& world, const glm::dvec3& open,
                         const glm::dvec3& closing)
{
    bounds directions; // unit vectors
    for (const bool last : {false, true})
        for (const glm::dvec3 corner : positions_at(casters, last))
            directions.include(glm::vec3(glm::normalize(corner - (last ? closing : open))));
    const glm::dvec3 direction(directions.centre());
    moving_camera light{{}, closing - open};
    double half_extent = 0, nearest = std::numeric_limits<double>::infinity(), farthest = 0;
    for (const bool last : {false, true}) {
        const glm::dvec3& position = last ? closing : open;
        light.open =
            perspective_view_from(position, position + direction, positions_at(world, last), glm::half_pi<double>(), 1);
        nearest = std::min(nearest, light.open.near_distance);
        farthest = std::max(farthest, light.open.far_distance);
        // In this view of 90 degrees, 2 (u, v) - 1 is (x / z, y / z): ratios of linear functions of time, which are
        // largest at an end.
        for (const glm::vec3& corner : positions_at(casters, last)) {
            if (!(view_distance(light.open, corner) > 0))
                throw std::invalid_argument("spot light: a caster is not in front of it");
            const glm::dvec2 seen = glm::abs(2.0 * glm::dvec2(project(light.open, corner)) - 1.0);
            half_extent = std::max({half_extent, seen.x, seen.y});
        }
    }
    light.open.position = open;
    light.open.half_extent = glm::dvec2(1.001 * half_extent); // rounding leaves no corner outside
    light.open.near_distance = nearest, light.open.far_distance = farthest;
    return light;
}

moving_stage staged(const moving_scene& casters, moving_scene world, const light_path& light, const viewpoint& eye,
                    double aspect, std::vector<point_of_interest> places)
{
    moving_stage result{std::move(world), {}, {}, std::move(places)};
    result.eye.open = perspective_view_from(eye.position, eye.target, bounds_of(result.world).corners(),
                                            glm::radians(eye.degrees), aspect);
    result.light = spot_light(casters, result.world, light.open, light.closing);
    return result;
}

moving_stage on_ground(const moving_scene& casters, const light_path& light, const viewpoint& eye, double aspect,
                       std::vector<point_of_interest> places)
{
    bounds covered = bounds_of(casters);
    for (const bool last : {false, true}) {
        const glm::dvec3& from = last ? light.closing : light.open;
        for (const glm::dvec3 corner : positions_at(casters, last))
            covered.include(glm::vec3(from + from.y / (from.y - corner.y) * (corner - from)));
    }
    const glm::vec3 centre = covered.centre(), extent = covered.extent();
    const float margin = 0.5f * std::max(extent.x, extent.z);
    moving_scene world = casters;
    add(world, ground({centre.x, 0, centre.z}, extent.x + margin, extent.z + margin, paint::stone), glm::vec3(0));
    return staged(casters, std::move(world), light, eye, aspect, std::move(places));
}

} // namespace gnomon::renderer
