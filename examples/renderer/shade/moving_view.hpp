// What a camera sees of a moving scene while the shutter is open, and what becomes of it in a picture: analytic, by
// what is in front when (Gribel et al. 2010; Palmer 2011, 2.1), or stochastic, at one time per sample (Akenine-Moller
// et al. 2007).
#pragma once

#include "renderer/output/image.hpp"
#include "renderer/raster/moving_rasterizer.hpp"
#include "renderer/scene/moving_scene.hpp"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::renderer {

// From t0 to t1 a pixel sees this triangle, a point of it that goes from p0 to p1; of one time only, t0 = t1.
struct seen_course {
    float t0, t1;
    float weight; // of its light in the pixel's; those of a pixel sum up to 1 at most, the rest is background
    std::uint32_t triangle;
    glm::vec3 p0, p1;
    glm::vec3 n0, n1; // unit normals of the triangle, towards the camera
};

struct seen_motion {
    int width = 0, height = 0;
    std::vector<std::uint32_t> first; // pixel i, row by row, has the courses first[i] to first[i + 1] - 1
    std::vector<seen_course> courses;

    std::span<const seen_course> operator()(std::size_t pixel) const
    {
        return std::span(courses).subspan(first[pixel], first[pixel + 1] - first[pixel]);
    }
};

// Courses are cut where depth departs by more than the tolerance from a line, so that positions do not either.
seen_motion camera_segments(const moving_scene& world, const camera& eye, int width, int height, float tolerance);

// At as many times for each pixel, one in every stratum of the shutter interval, its own ones.
seen_motion stochastic_visibility(const moving_scene& world, const camera& eye, int width, int height, int samples);

// The resolve: the lighting model of shading.hpp with a visibility of the light for each course.
picture shade(const moving_scene& world, const moving_camera& light, const seen_motion& seen,
              std::span<const float> visibility);

// Of each pixel, the mean over its courses by weight; 1 where it has none.
image<float> mean_visibility(const seen_motion& seen, std::span<const float> visibility);

} // namespace gnomon::renderer
