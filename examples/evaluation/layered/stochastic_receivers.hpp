// Samples of a stochastic camera as receivers in the light's shadow map: the place at the sample's time, the path of the
// surface, and the footprint that a sample stands for.
#pragma once

#include "evaluation/motion/light_receivers.hpp"
#include "renderer/scene/moving_scene.hpp"
#include "renderer/shade/moving_view.hpp"
#include "renderer/trace/tracer.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::evaluation {

// A point that the camera sees at one time, and at which the surface faces the light. Places and lengths are in texels of
// the map, depths have no bias but for what floats round.
struct stochastic_receiver {
    float x, y, depth, t; // in the map, and the time of the sample
    float slope;          // the most that depth changes per texel across the surface, at most at 80 degrees

    // The footprint: the ends at which the light sees the point at the times t0 and t1 if it stays where it is in the
    // camera's space, and the changes of its place along the surface for a pixel to the right and a pixel down.
    float x0, y0, t0, x1, y1, t1;
    float right_x, right_y, down_x, down_y;

    // The point of the surface while the shutter is open, with its triangle's number, and the times at which it faces the
    // light.
    light_receiver surface;

    float choice_x, choice_y;    // random numbers in [0, 1)
    renderer::receiver in_world; // at time t
};

// The point of the surface, nearer to the light by the slope over so many texels and by what floats round.
light_receiver biased_surface(const stochastic_receiver& of, float texels = float(motion_bias_radius));

// The receiver, nearer to the light by a constant of signed depth.
stochastic_receiver with_bias(stochastic_receiver of, float constant);

struct camera_samples {
    renderer::seen_motion seen; // segments of one time each
    int each;                   // samples of a pixel
    std::uint32_t seed;
    double camera_ms; // of one core
};

// The point of a triangle that the camera has seen at one time, while the shutter is open.
renderer::seen_segment followed(const renderer::moving_scene& world, const renderer::triangle_place& which,
                                const renderer::seen_segment& sample);

// The samples of a camera, so many in each pixel, and what they see.
camera_samples camera_samples_of(const renderer::moving_stage& stage, int width, int height, int each,
                                 std::uint32_t seed);

// The samples that face the light and that its map can hold, and the numbers of their segments. Other samples that face the
// light are lit, and those that do not face it are dark.
struct stochastic_receivers {
    std::vector<stochastic_receiver> where;
    std::vector<std::uint32_t> segments;
    std::vector<float> visibility; // of each segment; of those with receivers 1
};
stochastic_receivers stochastic_receivers_of(const camera_samples& samples, const renderer::moving_stage& stage,
                                             int resolution);

// Draws the choices of all receivers, each by the number of its segment.
void draw_choices(stochastic_receivers& of, std::uint32_t seed);

// The receivers in some of the pixels, each of which has true in the mask.
stochastic_receivers receivers_in(const std::vector<char>& pixels, const renderer::seen_motion& seen,
                                  const stochastic_receivers& all);

} // namespace gnomon::evaluation
