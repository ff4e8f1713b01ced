// Pictures in a medium: surfaces behind haze, and the light that the haze scatters once towards the camera.
#pragma once

#include "renderer/output/image.hpp"
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

} // namespace gnomon::renderer
