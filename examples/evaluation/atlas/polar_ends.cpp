// View rays at the ends of the range of polar angles: what is beyond the range is stored at its end, close to these rays,
// unless a guard band keeps rays away from the ends of depth.
#include "view_ray.hpp"

#include <algorithm>
#include <array>

namespace gnomon::evaluation::polar_ends {

namespace {

// The larger error of rays at either end. distance is that of the ray from the end as a share of the range, guard the
// share by which the range of depth is longer.
double error(const row_intensity& intensity, double distance, double guard)
{
    const auto ray = float((1 - 2 * distance) / (1 + guard));
    double worst = 0;
    for (const float share : {0.2f, 0.5f, 0.8f}) // in shadow
        worst = std::max({worst, error_of_row(intensity, std::array{layer{-1, share}, layer{0, 1 - share}}, -ray, 0.5f),
                          error_of_row(intensity, std::array{layer{0, share}, layer{1, 1 - share}}, ray, 0.5f)});
    return worst;
}

const registered<sweep> entry{sweep{
    .id = "polar_ends",
    .label = "Ends of the range of polar angles",
    .order = 170,
    .text =
        "A part of a row is in shadow. At one end of the range the surface that casts it is in front of all rays, "
        "at the other end nothing is behind the ray in the lit part: both are stored at an end of depth, and a guard "
        "band moves the rays away from there. Each point is the worst of both ends and three shares.",
    .x = {"distance", "distance of the ray from the end, as a share of the range", scale::log, 1e-4, 0.4, 30},
    .y = {"guard", "guard band as a share of the range", scale::linear, 0, 0.2, 21},
    .error_label = "error",
    .threshold = 0.1,
    .layers = [] { return layers_of_rows(error); }}};

} // namespace

} // namespace gnomon::evaluation::polar_ends
