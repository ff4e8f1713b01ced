#include "stochastic_receivers.hpp"

#include "evaluation/core/timing.hpp"
#include "renderer/shade/receivers.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

constexpr double rounding = 4e-6; // of floats that depth and time went through, over the range of depths
constexpr double grazing = 0.02;  // the least cosine to the view ray for which a pixel's footprint grows

// A number in [0, 1) for each index and seed.
float random_number(std::uint32_t index, std::uint32_t seed)
{
    std::uint32_t x = index * 0x9e3779b9u ^ seed * 0x85ebca6bu;
    x = (x ^ (x >> 16)) * 0x21f0aaadu;
    x = (x ^ (x >> 15)) * 0x735a2d97u;
    return float((x ^ (x >> 15)) >> 8) * 0x1p-24f;
}

class receiver_maker {
  public:
    receiver_maker(const camera_samples& samples, const moving_stage& stage, int resolution)
        : samples_(samples), eye_{stage.eye}, light_(stage.light), resolution_(resolution)
    {}

    // All but the surface and the choices.
    stochastic_receiver operator()(const seen_segment& s) const
    {
        const camera light = light_.at(double(s.t0));
        const glm::dvec3 p(s.p0);
        const glm::dvec4 place = in_texels(light, p);
        stochastic_receiver r{};
        r.in_world = {s.p0, s.n0};
        r.x = float(place.x / place.w), r.y = float(place.y / place.w), r.depth = float(place.z - rounding), r.t = s.t0;
        r.slope = float(plane_slope(p, glm::dvec3(s.n0), light, resolution_));
        const float half = 0.5f / float(samples_.each);
        r.t0 = std::max(s.t0 - half, 0.f), r.t1 = std::min(s.t0 + half, 1.f);
        const glm::dvec2 begin = held_in_view(s, r.t0), end = held_in_view(s, r.t1);
        r.x0 = float(begin.x), r.y0 = float(begin.y), r.x1 = float(end.x), r.y1 = float(end.y);
        const glm::dvec2 right = pixel_step(light, place, s, 0), down = pixel_step(light, place, s, 1);
        r.right_x = float(right.x), r.right_y = float(right.y), r.down_x = float(down.x), r.down_y = float(down.y);
        return r;
    }

    bool is_seen(const stochastic_receiver& r) const
    {
        const auto size = float(resolution_);
        return 0 <= r.x && r.x < size && 0 <= r.y && r.y < size && -1 <= r.depth && r.depth <= 1;
    }

  private:
    glm::dvec4 in_texels(const camera& light, const glm::dvec3& p) const
    {
        return texel_space(light, glm::dvec2(resolution_), p);
    }

    glm::dvec2 held_in_view(const seen_segment& s, float t) const
    {
        const glm::dvec4 place =
            in_texels(light_.at(double(t)), glm::dvec3(s.p0) + (double(t) - double(s.t0)) * eye_.motion);
        return glm::dvec2(place) / place.w;
    }

    // Texels that the place moves for one pixel along an axis of the picture.
    glm::dvec2 pixel_step(const camera& light, const glm::dvec4& place, const seen_segment& s, int axis) const
    {
        const camera eye = eye_.at(double(s.t0));
        const bool perspective = eye.perspective();
        const double distance = perspective ? view_distance(eye, glm::dvec3(s.p0)) : 1;
        const double pixel =
            2 * (axis == 0 ? eye.half_extent.x / samples_.seen.width : eye.half_extent.y / samples_.seen.height);
        const glm::dvec3 step = distance * pixel * (axis == 0 ? eye.right : -eye.up);
        const glm::dvec3 ray = perspective ? glm::normalize(glm::dvec3(s.p0) - eye.position) : eye.forward;
        const glm::dvec3 n(s.n0);
        const double cosine = std::min(glm::dot(n, ray), -grazing); // normals are towards the camera
        const glm::dvec3 along = step - ray * (glm::dot(n, step) / cosine);
        const glm::dvec4 moved = in_texels(light, glm::dvec3(s.p0) + along) - place;
        return (glm::dvec2(moved) - glm::dvec2(place) * (moved.w / place.w)) / place.w;
    }

    const camera_samples& samples_;
    moving_camera eye_;
    const moving_camera& light_;
    int resolution_;
};

} // namespace

seen_segment followed(const moving_scene& world, const triangle_place& which, const seen_segment& sample)
{
    const auto& part = world.open.meshes[which.mesh];
    const glm::uvec3& index = part.triangles[which.triangle];
    std::array<glm::dvec3, 3> open, closing, now;
    for (int i = 0; i < 3; ++i) {
        const auto k = std::size_t(i);
        open[k] = part.positions[index[i]], closing[k] = world.closing[which.mesh][index[i]];
        now[k] = glm::mix(open[k], closing[k], double(sample.t0));
    }
    const auto normal = [](const std::array<glm::dvec3, 3>& c) { return glm::cross(c[1] - c[0], c[2] - c[0]); };
    const glm::dvec3 n = normal(now), p(sample.p0);
    const double area = glm::dot(n, n);
    std::array<double, 3> weights{1, 0, 0};
    if (area > 0)
        for (std::size_t i = 0; i < 3; ++i)
            weights[i] = glm::dot(n, glm::cross(now[(i + 2) % 3] - now[(i + 1) % 3], p - now[(i + 1) % 3])) / area;
    glm::dvec3 first(0), last(0);
    for (std::size_t i = 0; i < 3; ++i) first += weights[i] * open[i], last += weights[i] * closing[i];
    const glm::dvec3 beside = p - glm::mix(first, last, double(sample.t0)); // of rounding
    const double side = glm::dot(n, glm::dvec3(sample.n0)) < 0 ? -1 : 1;
    const auto unit = [&](const std::array<glm::dvec3, 3>& c) {
        const glm::dvec3 m = side * normal(c);
        return glm::length(m) > 0 ? glm::vec3(glm::normalize(m)) : sample.n0;
    };
    return {0,
            1,
            sample.weight,
            sample.triangle,
            glm::vec3(first + beside),
            glm::vec3(last + beside),
            unit(open),
            unit(closing)};
}

light_receiver biased_surface(const stochastic_receiver& of, float texels)
{
    return with_bias(of, texels * of.slope).surface;
}

stochastic_receiver with_bias(stochastic_receiver of, float constant)
{
    of.depth -= constant;
    of.surface.path.depth.z0 -= constant, of.surface.path.depth.z1 -= constant;
    return of;
}

camera_samples camera_samples_of(const moving_stage& stage, int width, int height, int each, std::uint32_t seed)
{
    camera_samples result{{}, each, seed, 0};
    result.camera_ms = 1e3 * seconds_on_one_core([&] {
                           result.seen = stochastic_visibility(stage.world, stage.eye, width, height, each, seed);
                       });
    return result;
}

stochastic_receivers stochastic_receivers_of(const camera_samples& samples, const moving_stage& stage, int resolution)
{
    const auto& segments = samples.seen.segments;
    const receiver_maker make(samples, stage, resolution);
    const triangle_numbers numbers(stage.world.open);
    seen_motion surfaces{samples.seen.width, samples.seen.height, {}, std::vector<seen_segment>(segments.size())};
    std::vector<stochastic_receiver> all(segments.size());
    std::vector<char> faces(segments.size());
    tbb::parallel_for(std::size_t(0), segments.size(), [&](std::size_t i) {
        const seen_segment& s = segments[i];
        surfaces.segments[i] = followed(stage.world, numbers[s.triangle], s);
        const glm::dvec3 to_light = direction_towards(stage.light.at(double(s.t0)), glm::dvec3(s.p0));
        faces[i] = glm::dot(to_light, glm::dvec3(s.n0)) > 0;
        if (faces[i]) all[i] = make(s);
    });
    const std::vector<light_receiver> paths = light_receivers_of(surfaces, stage.light, resolution, 0);
    stochastic_receivers result{{}, {}, std::vector<float>(segments.size())};
    for (std::size_t i = 0; i < segments.size(); ++i) {
        result.visibility[i] = float(faces[i]);
        if (!faces[i] || !make.is_seen(all[i])) continue;
        result.where.push_back(all[i]);
        result.where.back().surface = paths[i];
        result.segments.push_back(std::uint32_t(i));
    }
    draw_choices(result, samples.seed);
    return result;
}

void draw_choices(stochastic_receivers& of, std::uint32_t seed)
{
    for (std::size_t i = 0; i < of.where.size(); ++i) {
        of.where[i].choice_x = random_number(2 * of.segments[i], seed);
        of.where[i].choice_y = random_number(2 * of.segments[i] + 1, seed);
    }
}

stochastic_receivers receivers_in(const std::vector<char>& pixels, const seen_motion& seen,
                                  const stochastic_receivers& all)
{
    std::vector<char> is_in(seen.segments.size());
    for (std::size_t pixel = 0; pixel < pixels.size(); ++pixel)
        std::fill(is_in.begin() + seen.first[pixel], is_in.begin() + seen.first[pixel + 1], pixels[pixel]);
    stochastic_receivers some{{}, {}, all.visibility};
    for (std::size_t i = 0; i < all.where.size(); ++i)
        if (is_in[all.segments[i]]) some.where.push_back(all.where[i]), some.segments.push_back(all.segments[i]);
    return some;
}

} // namespace gnomon::evaluation
