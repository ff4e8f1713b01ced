// The reference: hard shadows by ray tracing with Embree, at rest and while the shutter is open.
#pragma once

#include "renderer/output/image.hpp"
#include "renderer/raster/rasterizer.hpp"
#include "renderer/scene/camera.hpp"
#include "renderer/scene/moving_scene.hpp"
#include "renderer/scene/scene.hpp"

#include <glm/vec3.hpp>

#include <cstdint>
#include <memory>
#include <span>

namespace gnomon::renderer {

struct receiver {
    glm::vec3 position;
    glm::vec3 normal; // unit length, on the side from which the receiver is looked at

    friend bool operator==(const receiver&, const receiver&) = default;
};

// A receiver that goes along a straight line while the shutter is open; its normal goes over from one to the other.
struct receiver_course {
    receiver open, closing;
};

// What a ray meets first: a point of a triangle, the weights of whose corners sum to one.
struct hit {
    int mesh = -1; // index into scene::meshes, -1 where there is nothing
    std::uint32_t triangle = 0;
    glm::vec3 weights{0};
    glm::vec3 position{0};
    glm::vec3 normal{0}; // of the triangle at this time, unit length, towards the origin of the ray

    bool valid() const { return mesh >= 0; }
};

// The means of what a pixel sees while the shutter is open.
struct reference_picture {
    image<float> visibility; // of the light, over the times at which there is a surface; 1 where there never is
    image<float> coverage;   // the share of these times
    picture colour;          // over all times, shaded by the triangles' own normals
};

class tracer {
  public:
    explicit tracer(const scene& world);
    explicit tracer(moving_scene world);
    ~tracer();
    tracer(tracer&&) noexcept;
    tracer& operator=(tracer&&) noexcept;

    // 1 where the receiver sees the light, 0 where something lies in between. A ray starts off the surface, so that it
    // does not meet it again. Parallel over receivers. The shutter has just opened.
    void visibility(const camera& light, std::span<const receiver> receivers, std::span<float> result) const;

    // The same at a time in [0, 1] for each receiver.
    void visibility(const moving_camera& light, std::span<const receiver> receivers, std::span<const float> times,
                    std::span<float> result) const;

    // The share of `samples` times, one in each of as many equal parts of [0, 1], at which a receiver sees the light.
    // Where in its part a moment lies depends on the index of the receiver and on nothing else. While it faces away
    // from the light, a receiver does not see it. Parallel over receivers.
    void mean_visibility(const moving_camera& light, std::span<const receiver_course> receivers, int samples,
                         std::span<float> result) const;

    // What a ray meets first at a time in [0, 1].
    hit first_hit(const view_ray& ray, float time) const;

    // The place of a hit's point on its triangle at a time in [0, 1], and the normal on the side that the hit has seen.
    receiver_course receiver_of(const hit& seen, float time_of_hit) const;

    // How far along the normal a ray starts: a few roundings of the scene's diagonal.
    float offset() const;

    // What a camera at rest sees through the centre of each pixel at `samples` times, one in each of as many equal
    // parts of [0, 1], chosen by the index of the pixel. Parallel over pixels.
    reference_picture photograph(const moving_camera& light, const camera& eye, int width, int height,
                                 int samples) const;

  private:
    struct state;
    std::unique_ptr<state> state_;
};

// The visibility of each pixel's surface; 1 for the background.
image<float> traced_visibility(const tracer& rays, const camera& light, const image<surface>& seen);

} // namespace gnomon::renderer
