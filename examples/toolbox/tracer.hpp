// The reference: hard shadows by ray tracing with Embree.
#pragma once

#include <glm/vec3.hpp>
#include <memory>
#include <span>

#include "camera.hpp"
#include "image.hpp"
#include "rasterizer.hpp"
#include "scene.hpp"

namespace gnomon::toolbox {

struct receiver {
    glm::vec3 position;
    glm::vec3 normal; // unit length, on the side from which the receiver is looked at
};

class tracer {
  public:
    explicit tracer(const scene& world);
    ~tracer();
    tracer(tracer&&) noexcept;
    tracer& operator=(tracer&&) noexcept;

    // 1 where the receiver sees the light, 0 where something lies in between. A ray starts off the surface, so that it
    // does not meet it again. Parallel over receivers.
    void visibility(const camera& light, std::span<const receiver> receivers, std::span<float> result) const;

    // How far along the normal a ray starts: a few roundings of the scene's diagonal.
    float offset() const;

  private:
    struct state;
    std::unique_ptr<state> state_;
};

// The visibility of each pixel's surface; 1 for the background.
image<float> traced_visibility(const tracer& rays, const camera& light, const image<surface>& seen);

} // namespace gnomon::toolbox
