// Speed, and how much motions differ that a layer averages.
#include "moving_sheets.hpp"
#include "sweep.hpp"

#include <vector>

namespace gnomon::evaluation::layer_motion {

namespace {

double error(const sheet_method& m, double speed, double difference)
{
    const std::vector<moving_sheet> sheets{
        {.direction = 0.6, .depth = -0.5, .speed = speed},
        {.direction = 0.6, .depth = -0.499, .speed = speed * (1 - difference), .period = 41}};
    return error_behind(sheets, 4, m);
}

std::vector<sweep_layer> layers()
{
    std::vector<sweep_layer> result;
    for (const sheet_method& m : sheet_methods())
        result.push_back({m.id, m.label, [m](double x, double y) { return error(m, x, y); }});
    return result;
}

const registered<sweep> entry{
    sweep{.id = "layer_motion",
          .label = "Speed, and spread of motion in a layer",
          .order = 240,
          .text = "Two sheets of stripes move at nearly the same depth, one slower than the other or against it, so "
                  "that they share "
                  "a layer. Pixels behind them are static in the map or follow the faster sheet.",
          .x = {"speed", "motion of the faster sheet in texels", scale::log, 0.5, 32, 10},
          .y = {"difference", "difference of both motions, as a share of that", scale::linear, 0, 2, 6},
          .error_label = "root mean square error",
          .threshold = 0.12,
          .layers = layers}};

} // namespace

} // namespace gnomon::evaluation::layer_motion
