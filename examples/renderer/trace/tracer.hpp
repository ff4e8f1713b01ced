// The reference by ray tracing with Embree: hard shadows of a static scene and while the shutter is open, the shadows of
// lights with an area, and those of translucent meshes.
//
// Translucent meshes cast shadows like opaque ones, except where a function says otherwise.
#pragma once

#include "renderer/output/image.hpp"
#include "renderer/raster/rasterizer.hpp"
#include "renderer/scene/area_light.hpp"
#include "renderer/scene/camera.hpp"
#include "renderer/scene/moving_scene.hpp"
#include "renderer/scene/scene.hpp"
#include "renderer/shade/layers.hpp"

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

// A receiver that moves along a straight line while the shutter is open; its normal is interpolated.
struct receiver_motion {
    receiver open, closing;
};

// The first point on a ray: a point of a triangle, by weights of its corners, which sum to 1.
struct hit {
    int mesh = -1; // index into scene::meshes, -1 if the ray meets nothing
    std::uint32_t triangle = 0;
    glm::vec3 weights{0};
    glm::vec3 position{0};
    glm::vec3 normal{0}; // of the triangle at this time, unit length, towards the origin of the ray

    bool valid() const { return mesh >= 0; }
};

// Means over the time for which the shutter is open, for each pixel.
struct reference_picture {
    image<float> visibility; // of the light, over the times at which the pixel sees a surface; 1 if it never does
    image<float> coverage;   // fraction of the time at which the pixel sees a surface
    picture colour;          // over all times, shaded by the triangles' own normals
};

class tracer {
  public:
    explicit tracer(const scene& world);
    explicit tracer(moving_scene world);
    ~tracer();
    tracer(tracer&&) noexcept;
    tracer& operator=(tracer&&) noexcept;

    // 1 for a receiver that sees the light when the shutter opens, 0 for one that does not. A ray starts off its
    // surface, so that it does not meet that surface again. Parallel over receivers.
    void visibility(const camera& light, std::span<const receiver> receivers, std::span<float> result) const;

    // The share of red, green and blue light that reaches a receiver through translucent meshes: the product of
    // 1 - opacity over all crossings of its ray, 0 behind an opaque mesh. A crossing at an edge that two triangles share is
    // one. Parallel over receivers.
    void transmittance(const camera& light, std::span<const receiver> receivers, std::span<glm::vec3> result) const;

    // The fraction of an area light that a receiver sees, by rays to `samples` places of the light, stratified; those of a
    // receiver depend on its index alone. The part of the light below the plane of a receiver is not seen. Parallel over
    // receivers.
    void visibility(const area_light& light, std::span<const receiver> receivers, int samples,
                    std::span<float> result) const;

    // The same with translucent meshes: the mean transmittance of the rays.
    void transmittance(const area_light& light, std::span<const receiver> receivers, int samples,
                       std::span<glm::vec3> result) const;

    // The visibility of each receiver at a time of its own, in [0, 1].
    void visibility(const moving_camera& light, std::span<const receiver> receivers, std::span<const float> times,
                    std::span<float> result) const;

    // The transmittance at a time of its own for each receiver; 0 for one that faces away from the light.
    void transmittance(const moving_camera& light, std::span<const receiver> receivers, std::span<const float> times,
                       std::span<glm::vec3> result) const;

    // The fraction of `samples` times, one in each of as many equal parts of [0, 1], at which a receiver sees the
    // light. A time within its part depends on the index of the receiver alone. A receiver that faces away from the
    // light does not see it. Parallel over receivers.
    void mean_visibility(const moving_camera& light, std::span<const receiver_motion> receivers, int samples,
                         std::span<float> result) const;

    // The first point on a ray at a time in [0, 1].
    hit first_hit(const view_ray& ray, float time) const;

    // The path of the point of a triangle that a ray has met, at shutter open and close; normals on the side of the
    // hit.
    receiver_motion receiver_of(const hit& seen, float time_of_hit) const;

    // Distance along the normal at which a ray starts: a few roundings of the scene's diagonal.
    float offset() const;

    // The picture of a camera: rays through the centre of each pixel at `samples` times, one in each of as many equal
    // parts of [0, 1], chosen by the index of the pixel. Parallel over pixels.
    reference_picture photograph(const moving_camera& light, const moving_camera& eye, int width, int height,
                                 int samples) const;

  private:
    struct state;
    std::unique_ptr<state> state_;
};

// The visibility of each pixel's surface; 1 for the background.
image<float> traced_visibility(const tracer& rays, const camera& light, const image<surface>& seen);

// The visibility of each pixel's surface by rays to an area light.
image<float> traced_visibility(const tracer& rays, const area_light& light, const image<surface>& seen, int samples);

// The transmittance at each surface. At translucent ones the rays start on the side of the light.
layer_visibility traced_transmittance(const tracer& rays, const camera& light, const surface_layers& seen);

} // namespace gnomon::renderer
