// The places of moving triangles over the whole shutter interval, as boxes in a tree.
#pragma once

#include "embree.hpp"
#include "ray_packet.hpp"
#include "renderer/scene/moving_scene.hpp"

#include <vector>

namespace gnomon::renderer {

class swept_triangles {
  public:
    // Of all triangles of the meshes that move, in boxes larger by the margin on each side. The margin covers the rounding
    // of intersections.
    swept_triangles(RTCDevice device, const moving_scene& world, float margin);
    swept_triangles(const swept_triangles&) = delete;
    swept_triangles& operator=(const swept_triangles&) = delete;

    // True if the ray crosses the box of a triangle. False means that it meets none of them at any time.
    bool near(const segment& ray) const;

  private:
    std::vector<bounds> boxes_;
    owned<RTCScene> tree_;
};

} // namespace gnomon::renderer
