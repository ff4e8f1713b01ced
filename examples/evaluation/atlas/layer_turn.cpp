// Turning sheets, whose motion changes within a tile.
#include "moving_sheets.hpp"
#include "sweep.hpp"

#include <vector>

namespace gnomon::evaluation::layer_turn {

namespace {

double error(const sheet_method& m, double turn, double distance)
{
    return error_behind({{.direction = 0.6, .turn = turn, .distance = distance}}, 4, m);
}

std::vector<sweep_layer> layers()
{
    std::vector<sweep_layer> result;
    for (const sheet_method& m : sheet_methods())
        result.push_back({m.id, m.label, [m](double x, double y) { return error(m, x, y); }});
    return result;
}

const registered<sweep> entry{sweep{.id = "layer_turn",
                                    .label = "Rotation in a tile",
                                    .order = 245,
                                    .text = "A sheet of stripes turns while the shutter is open. Pixels behind it are "
                                            "static in the map or follow the sheet.",
                                    .x = {"turn", "angle in radians", scale::log, 0.05, 3.1, 10},
                                    .y = {"distance", "distance of the axis in texels", scale::linear, 0, 24, 5},
                                    .error_label = "root mean square error",
                                    .threshold = 0.12,
                                    .layers = layers}};

} // namespace

} // namespace gnomon::evaluation::layer_turn
