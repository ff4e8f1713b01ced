// The view of a camera on a moving scene while the shutter is open, and the picture that follows from it: analytic, as
// segments of time with one triangle in front (Gribel et al. 2010; Palmer 2011, 2.1), or stochastic, by samples of one
// time each (Akenine-Moller et al. 2007).
#pragma once

#include "renderer/output/image.hpp"
#include "renderer/raster/moving_rasterizer.hpp"
#include "renderer/raster/moving_samples.hpp"
#include "renderer/scene/moving_scene.hpp"

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::renderer {

// A point of a triangle that a pixel sees from t0 to t1, and that goes from p0 to p1 meanwhile. A sample has t0 = t1.
struct seen_segment {
    float t0, t1;
    float weight; // share of the pixel's light; the weights of a pixel sum to 1 at most, the rest is background
    std::uint32_t triangle;
    glm::vec3 p0, p1;
    glm::vec3 n0, n1; // unit normals of the triangle, towards the camera
};

struct seen_motion {
    int width = 0, height = 0;
    std::vector<std::uint32_t> first; // pixel i, row by row, sees segments first[i] to first[i + 1] - 1
    std::vector<seen_segment> segments;

    std::span<const seen_segment> operator()(std::size_t pixel) const
    {
        return std::span(segments).subspan(first[pixel], first[pixel + 1] - first[pixel]);
    }
};

// The analytic view: the segments of each pixel. A segment ends where depth departs by more than the tolerance from a
// line, so that positions do not depart further either.
seen_motion camera_segments(const moving_scene& world, const moving_camera& eye, int width, int height,
                            float tolerance);

// The stochastic view through the centre of each pixel: `samples` times, one in each stratum of the shutter interval. They
// are independent of those of a shadow map of any seed.
seen_motion stochastic_visibility(const moving_scene& world, const moving_camera& eye, int width, int height,
                                  int samples, std::uint32_t seed = 0);

// The picture under the lighting model of shading.hpp, with a visibility of the light for each segment.
picture shade(const moving_scene& world, const moving_camera& light, const seen_motion& seen,
              std::span<const float> visibility);

// The mean visibility of each pixel, over its segments by weight; 1 where a pixel has none.
image<float> mean_visibility(const seen_motion& seen, std::span<const float> visibility);

} // namespace gnomon::renderer
