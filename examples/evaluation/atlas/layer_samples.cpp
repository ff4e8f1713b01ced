// Samples of the map, and surfaces one behind the other.
#include "moving_sheets.hpp"
#include "sweep.hpp"

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace gnomon::evaluation::layer_samples {

namespace {

// Sheets at even distances in depth, in directions of their own, which let half of the light through together.
double error(const sheet_method& m, double samples, double surfaces)
{
    constexpr double period = 48;
    const int count = int(std::lround(surfaces));
    std::vector<moving_sheet> sheets;
    for (int i = 0; i < count; ++i)
        sheets.push_back({.direction = 0.6 + 2.4 * i,
                          .depth = -0.8 + 1.5 * i / (count > 1 ? count - 1 : 1),
                          .speed = 12,
                          .stripe = period * (1 - std::pow(0.5, 1 / surfaces)),
                          .period = period});
    return error_behind(sheets, int(std::lround(samples)), m);
}

std::vector<sweep_layer> layers()
{
    std::vector<sheet_method> methods;
    for (std::size_t most = 1; most <= 4; ++most)
        methods.push_back(layers_with("layers_" + std::to_string(most),
                                      "at most " + std::to_string(most) + (most > 1 ? " layers" : " layer"),
                                      {.layers = most}));
    methods.push_back(time_dependent_sheets());
    methods.back().id += "_samples";
    std::vector<sweep_layer> result;
    for (const sheet_method& m : methods)
        result.push_back({m.id, m.label, [m](double x, double y) { return error(m, x, y); }});
    return result;
}

const registered<sweep> entry{sweep{.id = "layer_samples",
                                    .label = "Samples and layers",
                                    .order = 250,
                                    .text = "Sheets of stripes one behind the other, each with a motion of 12 texels "
                                            "in a direction of its own. Pixels behind "
                                            "them are static in the map or follow the first sheet.",
                                    .x = {"samples", "samples for each texel of the map", scale::log, 1, 16, 5},
                                    .y = {"surfaces", "number of sheets", scale::linear, 1, 6, 6},
                                    .error_label = "root mean square error",
                                    .threshold = 0.1,
                                    .layers = layers}};

} // namespace

} // namespace gnomon::evaluation::layer_samples
