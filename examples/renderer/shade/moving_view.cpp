#include "moving_view.hpp"

#include "shading.hpp"

#include <gnomon/motion/range/range.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

namespace gnomon::renderer {

namespace {

class surfaces {
  public:
    surfaces(const moving_scene& world, const moving_camera& eye, int width, int height)
        : world_(world), eye_(eye), size_(width, height), numbers_(world.open)
    {}

    // The segments of a pixel without their weights.
    seen_segment at(std::size_t pixel, const depth_time_range<float>& r) const
    {
        const auto width = static_cast<std::size_t>(size_.x);
        const view_ray ray = ray_through(
            eye_.open,
            glm::dvec2(static_cast<double>(pixel % width) + 0.5, static_cast<double>(pixel / width) + 0.5) / size_);
        const auto number = static_cast<std::uint32_t>(r.id);
        const auto position = [&](float depth, float t) {
            const double passed = 0.5 + 0.5 * double(depth);
            const double distance = glm::mix(eye_.open.near_distance, eye_.open.far_distance, passed);
            return glm::vec3(ray.origin + double(t) * eye_.motion + distance * ray.direction);
        };
        return {r.t0,
                r.t1,
                0,
                number,
                position(r.z0, r.t0),
                position(r.z1, r.t1),
                normal(number, r.t0, ray),
                normal(number, r.t1, ray)};
    }

  private:
    glm::vec3 normal(std::uint32_t number, float t, const view_ray& ray) const
    {
        const triangle_place place = numbers_[number];
        const mesh& part = world_.open.meshes[place.mesh];
        const glm::uvec3& index = part.triangles[place.triangle];
        const auto corner = [&](std::uint32_t i) {
            return glm::mix(glm::dvec3(part.positions[i]), glm::dvec3(world_.closing[place.mesh][i]), double(t));
        };
        const glm::dvec3 a = corner(index.x), n = glm::cross(corner(index.y) - a, corner(index.z) - a);
        const double length = glm::length(n), side = glm::dot(n, ray.direction) > 0 ? -1 : 1;
        return length > 0 ? glm::vec3(side / length * n) : glm::vec3(-ray.direction); // seen edge-on for an instant
    }

    const moving_scene& world_;
    const moving_camera& eye_;
    glm::dvec2 size_;
    triangle_numbers numbers_;
};

float sunlight(const camera& light, const glm::vec3& p, const glm::vec3& n)
{
    return std::max(glm::dot(glm::vec3(direction_towards(light, p)), n), 0.f);
}

} // namespace

seen_motion camera_segments(const moving_scene& world, const moving_camera& eye, int width, int height, float tolerance)
{
    range_rasterizer rasterize;
    const range_lists& lists = rasterize(world, eye, width, height, {.resolved = true, .depth_tolerance = tolerance});
    const surfaces of(world, eye, width, height);
    const range_map<float> map = lists.map();
    const auto list = [&](std::size_t pixel) { return map(pixel % map.width, pixel / map.width); };
    seen_motion result{width, height, {0}, std::vector<seen_segment>(lists.ranges.size())};
    for (std::size_t pixel = 0; pixel < map.width * map.height; ++pixel)
        result.first.push_back(result.first.back() + std::uint32_t(list(pixel).size()));
    tbb::parallel_for(std::size_t(0), map.width * map.height, [&](std::size_t pixel) {
        std::size_t i = result.first[pixel];
        for (const depth_time_range<float>& r : list(pixel)) {
            result.segments[i] = of.at(pixel, r);
            result.segments[i++].weight = range_duration(r);
        }
    });
    return result;
}

seen_motion stochastic_visibility(const moving_scene& world, const moving_camera& eye, int width, int height,
                                  int samples, std::uint32_t seed)
{
    constexpr std::uint32_t apart = 0x5bd1e995; // from the seeds of shadow maps
    const sample_picture drawn =
        rasterize_samples(world, eye, width, height, {samples, seed ^ apart, sample_pattern::centres});
    const surfaces of(world, eye, width, height);
    const auto each = static_cast<std::size_t>(samples);
    seen_motion result{width, height, {0}, {}};
    for (std::size_t i = 0; i < drawn.of.size(); ++i) {
        const stochastic_sample<float>& s = drawn.of[i];
        if (s.id >= 0) {
            result.segments.push_back(of.at(i / each, {s.t, s.t, s.z, s.z, s.id}));
            result.segments.back().weight = 1 / static_cast<float>(samples);
        }
        if (i % each == each - 1) result.first.push_back(static_cast<std::uint32_t>(result.segments.size()));
    }
    return result;
}

picture shade(const moving_scene& world, const moving_camera& light, const seen_motion& seen,
              std::span<const float> visibility)
{
    const triangle_numbers numbers(world.open);
    picture result(seen.width, seen.height);
    tbb::parallel_for(std::size_t(0), result.pixels.size(), [&](std::size_t pixel) {
        float background = 1;
        glm::vec3 sum(0);
        for (std::size_t i = seen.first[pixel]; i < seen.first[pixel + 1]; ++i) {
            const seen_segment& c = seen.segments[i];
            const glm::vec3& albedo = world.open.meshes[numbers[c.triangle].mesh].albedo;
            const auto seen_at = [&](float t, const glm::vec3& p, const glm::vec3& n) {
                return radiance(albedo, n, visibility[i] * sunlight(light.at(double(t)), p, n));
            };
            sum += 0.5f * c.weight * (seen_at(c.t0, c.p0, c.n0) + seen_at(c.t1, c.p1, c.n1));
            background -= c.weight;
        }
        result.pixels[pixel] = sum + std::max(background, 0.f) * daylight.background;
    });
    return result;
}

image<float> mean_visibility(const seen_motion& seen, std::span<const float> visibility)
{
    image<float> result(seen.width, seen.height, 1);
    for (std::size_t pixel = 0; pixel < result.pixels.size(); ++pixel) {
        float sum = 0, weight = 0;
        for (std::size_t i = seen.first[pixel]; i < seen.first[pixel + 1]; ++i) {
            sum += seen.segments[i].weight * visibility[i];
            weight += seen.segments[i].weight;
        }
        if (weight > 0) result.pixels[pixel] = sum / weight;
    }
    return result;
}

} // namespace gnomon::renderer
