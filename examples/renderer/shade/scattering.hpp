// Pictures in a medium: surfaces behind haze, and the light that the haze scatters once towards the camera.
#pragma once

#include "layers.hpp"
#include "renderer/output/image.hpp"
#include "renderer/raster/fragments.hpp"
#include "renderer/raster/rasterizer.hpp"
#include "renderer/scene/scattering_stages.hpp"

namespace gnomon::renderer {

// The distance from the camera to the surface of each pixel, along the ray; for the background up to the far plane.
image<float> ray_lengths(const camera& eye, const image<surface>& seen);

// The ray through the centre of a pixel, of unit direction.
view_ray unit_ray(const camera& eye, int x, int y, int width, int height);

// The share of light that passes the first `length` of a ray of unit direction.
glm::vec3 transmittance(const medium& air, const view_ray& ray, double length);

// The radiance that lit air on the first `length` of a ray of unit direction scatters towards its origin.
glm::vec3 scattered_radiance(const medium& air, const camera& light, const view_ray& ray, double length);

// Peters et al. 2017, Section 5.1.1: e^(-sigma s) L_s + V times the scattered radiance of lit air. L_s is the colour of a
// pixel of `surfaces`, s its distance, V the visible share of its scattering. Of each channel by its own coefficients.
picture with_scattering(const picture& surfaces, const image<float>& distance, const image<float>& visibility,
                        const scattering_stage& where);

// The distances of opaque surfaces as above, and those of the layers.
per_surface<float> ray_lengths(const camera& eye, const surface_layers& seen);

// The same for each surface by its own distance and visible share: forward shading. Surfaces are then blended() as without
// haze. This is exact: haze between two layers is dimmed by the nearer one.
per_surface<glm::vec3> with_scattering(const surface_layers& seen, const per_surface<glm::vec3>& radiances,
                                       const per_surface<float>& distance, const per_surface<float>& visibility,
                                       const scattering_stage& where);

} // namespace gnomon::renderer
