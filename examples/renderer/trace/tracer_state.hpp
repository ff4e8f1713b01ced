// The insides of the tracer, for its own files alone.
#pragma once

#include "embree.hpp"
#include "ray_packet.hpp"
#include "renderer/shade/shading.hpp"
#include "swept_triangles.hpp"
#include "tracer.hpp"

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <vector>

namespace gnomon::renderer {

inline glm::vec3 unit(const glm::vec3& v)
{
    const float length = glm::length(v);
    return length > 0 ? v / length : v;
}

struct corners {
    std::array<glm::vec3, 3> at;

    glm::vec3 inside(const glm::vec3& weights) const
    {
        return weights.x * at[0] + weights.y * at[1] + weights.z * at[2];
    }
    glm::vec3 normal() const
    {
        return unit(
            glm::vec3(glm::cross(glm::dvec3(at[1]) - glm::dvec3(at[0]), glm::dvec3(at[2]) - glm::dvec3(at[0]))));
    }
};

inline void check_samples(int samples)
{
    if (samples < 1) throw std::invalid_argument(fmt::format("tracer: {} samples, at least one expected", samples));
}

inline void check_room(std::size_t receivers, std::size_t results)
{
    if (receivers != results)
        throw std::invalid_argument(fmt::format("tracer: {} receivers, room for {} results", receivers, results));
}

struct tracer::state {
    moving_scene world;
    std::vector<bool> moves;
    owned<RTCDevice> device{rtcNewDevice(nullptr)};
    owned<RTCScene> scene;
    std::unique_ptr<swept_triangles> swept; // of meshes that move; null where none does
    float offset = 0;

    // A spot light's ray is the segment up to the light, a directional one has no end.
    segment to_light(const receiver& from, const moving_camera& light, float time) const
    {
        const glm::vec3 origin = from.position + offset * from.normal;
        if (!light.open.perspective()) return {origin, glm::vec3(-light.open.forward), endless};
        const glm::dvec3 place = light.open.position + static_cast<double>(time) * light.motion;
        return {origin, glm::vec3(place - glm::dvec3(origin)), 1};
    }

    // The cosine between the receiver's normal and the direction to the light.
    float aim(RTCRay16& rays, int lane, const receiver& from, const moving_camera& light, float time) const
    {
        const segment ray = to_light(from, light, time);
        set_ray(rays, lane, ray, time);
        return glm::dot(from.normal, unit(ray.direction));
    }

    // The cosine between the receiver's normal and the direction to a place of the light.
    float aim(RTCRay16& rays, int lane, const receiver& from, const area_light& light, const glm::dvec2& place) const
    {
        const glm::vec3 origin = from.position + offset * from.normal;
        const glm::vec3 direction(towards(light, origin, place));
        set_ray(rays, lane, {origin, direction, light.map.perspective() ? 1.f : endless}, 0);
        return glm::dot(from.normal, unit(direction));
    }

    // True if no triangle of a moving mesh comes near the ray: then the ray meets the same point at all times.
    bool always_alike(const segment& ray) const { return !swept || !swept->near(ray); }

    bool always_alike(const receiver& from, const moving_camera& light) const
    {
        return light.motion == glm::dvec3(0) && always_alike(to_light(from, light, 0));
    }

    // Ends the rays of a packet that meet something: tfar becomes -infinity. Translucent meshes are met as others
    // are, unless crossings are gathered.
    void trace(const mask& valid, RTCRay16& rays, crossings* gathered = nullptr) const
    {
        occlude(valid.data(), scene.get(), rays, gathered);
    }

    void look(const mask& valid, RTCRayHit16& rays) const { intersect(valid.data(), scene.get(), rays); }

    glm::vec3 colour(const hit& seen, float sunlight) const
    {
        if (!seen.valid()) return daylight.background;
        return radiance(world.open.meshes[static_cast<std::size_t>(seen.mesh)].albedo, seen.normal, sunlight);
    }

    corners triangle(std::size_t mesh, std::uint32_t index, float time) const
    {
        const auto& part = world.open.meshes[mesh];
        const glm::uvec3 t = part.triangles[index];
        corners result;
        for (int i = 0; i < 3; ++i) {
            const glm::vec3& open = part.positions[t[i]];
            result.at[static_cast<std::size_t>(i)] =
                moves[mesh] ? glm::mix(open, world.closing[mesh][t[i]], time) : open;
        }
        return result;
    }

    // The first point that a ray of a packet has met in this direction.
    hit met(const RTCRayHit16& rays, int lane, const glm::dvec3& direction) const
    {
        hit result;
        if (rays.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID) return result;
        const float u = rays.hit.u[lane], v = rays.hit.v[lane];
        const corners at = triangle(rays.hit.geomID[lane], rays.hit.primID[lane], rays.ray.time[lane]);
        result.mesh = static_cast<int>(rays.hit.geomID[lane]), result.triangle = rays.hit.primID[lane];
        result.weights = {1 - u - v, u, v};
        result.position = at.inside(result.weights);
        result.normal = at.normal();
        if (glm::dot(glm::dvec3(result.normal), direction) > 0) result.normal = -result.normal;
        return result;
    }
};

} // namespace gnomon::renderer
