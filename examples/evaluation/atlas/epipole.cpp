// View rays into the light: no occluder can be far in front of them in depth, so the bounds of the shadow are wide, and the
// place between them decides whether light leaks (Peters et al. 2017, Fig. 14).
#include "view_ray.hpp"

#include <gnomon/scattering/rectified.h>
#include <gnomon/scattering/single_scattering.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace gnomon::evaluation::epipole {

namespace {

constexpr double pi = 3.141592653589793;

using overestimation_of = float (*)(double polar);

// A camera that sees 60 degrees to one side of the light. An occluder is halfway between the ray and the light; two
// surfaces are behind the ray.
double error(const row_intensity& intensity, double degrees, double shadow, overestimation_of overestimation)
{
    const auto range = rectified_polar_range(float(2 * pi / 3), float(pi));
    const auto depth = [&](double angle) { return rectified_polar_depth(float(pi - angle * pi / 180), range); };
    const auto rest = float((1 - shadow) / 2);
    return error_of_row(intensity,
                        std::array{layer{depth(degrees / 2), float(shadow)}, layer{depth((degrees + 60) / 2), rest},
                                   layer{depth(60), rest}},
                        depth(degrees), overestimation(pi - degrees * pi / 180));
}

std::vector<sweep_layer> layers()
{
    struct bound {
        std::string id, label;
        overestimation_of overestimation;
    };
    const std::array bounds{
        bound{"lower", "lower bound of shadow", [](double) { return 1.0f; }},
        bound{"middle", "middle", [](double) { return 0.5f; }},
        bound{"adaptive", "adaptive", [](double polar) { return adaptive_overestimation(float(std::cos(polar))); }},
        bound{"plateau", "plateau", [](double polar) { return plateau_overestimation(float(std::cos(polar))); }}};
    std::vector<sweep_layer> result;
    for (const row_format& f : row_formats()) {
        if (f.id != "moments4_unorm16_row" && f.id != "moments6_unorm10_row") continue;
        for (const bound& b : bounds)
            result.push_back({f.id + '_' + b.id, f.label + ", " + b.label, [=](double degrees, double shadow) {
                                  return error(f.intensity, degrees, shadow, b.overestimation);
                              }});
    }
    return result;
}

const registered<sweep> entry{
    sweep{.id = "epipole",
          .label = "Rays into the light",
          .order = 180,
          .text = "The camera sees 60 degrees to one side of the light. In one part of a row an occluder is halfway "
                  "between ray and light, in the rest two surfaces are behind the ray.",
          .x = {"angle", "angle between ray and light in degrees", scale::log, 0.1, 55, 30},
          .y = {"shadow", "part of the row in shadow", scale::linear, 0, 1, 16},
          .error_label = "error",
          .threshold = 0.1,
          .layers = layers}};

} // namespace

} // namespace gnomon::evaluation::epipole
