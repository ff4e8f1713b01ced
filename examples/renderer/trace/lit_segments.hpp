// The lit parts of view rays under a directional light, and the scattering in them: the reference of single scattering.
// Nothing is sampled. A triangle shadows the part of a ray that lies in the prism behind the triangle, which four linear
// functions bound; Embree finds the triangles.
#pragma once

#include "renderer/output/image.hpp"
#include "renderer/scene/camera.hpp"
#include "renderer/scene/medium.hpp"
#include "renderer/scene/scene.hpp"
#include "renderer/shade/layers.hpp"

#include <memory>
#include <span>
#include <vector>

namespace gnomon::renderer {

// The points of a ray at distances from `from` to `to`.
struct lit_segment {
    double from, to;

    friend bool operator==(const lit_segment&, const lit_segment&) = default;
};

// The prisms behind all triangles of a scene, translucent ones included. Thread-safe for queries.
class shadow_volumes {
  public:
    // Throws std::invalid_argument if the light is not directional.
    shadow_volumes(const scene& casters, const camera& light);
    ~shadow_volumes();
    shadow_volumes(shadow_volumes&&) noexcept;
    shadow_volumes& operator=(shadow_volumes&&) noexcept;

    // The lit parts of the first `length` of a ray of unit direction, in order and disjoint. The length may be infinite.
    // Parts shorter than 1e-9 of the scene's diagonal are left out: they are gaps between triangles, by rounding.
    std::vector<lit_segment> lit(const view_ray& ray, double length) const;

  private:
    struct state;
    std::unique_ptr<state> state_;
};

// The light that the lit parts scatter towards the origin of a ray, as a share in [0, 1] of the light that the first
// `length` of the ray would scatter if all of it was lit. 1 for a ray of no length. By the medium's mean extinction.
double visible_share(std::span<const lit_segment> lit, const medium& air, const view_ray& ray, double length);

// The visible share for each ray, over its own length. Parallel over rays.
void traced_scattering(const shadow_volumes& shadows, const medium& air, std::span<const view_ray> rays,
                       std::span<const double> lengths, std::span<float> result);

// The visible share for the ray through the centre of each pixel.
image<float> traced_scattering(const shadow_volumes& shadows, const medium& air, const camera& eye,
                               const image<float>& lengths);

// The visible share for each surface, up to the surface. Only what is in the shadow volumes casts shadows.
per_surface<float> traced_scattering(const shadow_volumes& shadows, const medium& air, const camera& eye,
                                     const surface_layers& seen, const per_surface<float>& lengths);

} // namespace gnomon::renderer
