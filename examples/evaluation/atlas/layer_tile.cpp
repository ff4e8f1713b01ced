// Sizes of tiles, of the windows around them, and of their layers.
#include "moving_sheets.hpp"
#include "sweep.hpp"

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace gnomon::evaluation::layer_tile {

namespace {

double error(std::size_t tile, std::size_t guard, std::size_t texels, double speed)
{
    const sheet_method m = layers_with("", "", {.tile = tile, .guard = guard * tile, .texels = texels * tile});
    return error_behind({{.direction = 0.6, .speed = speed}, {.direction = 3, .depth = 0.5, .speed = speed}}, 4, m);
}

std::vector<sweep_layer> layers()
{
    std::vector<sweep_layer> result;
    for (const std::size_t guard : {2u, 3u})
        for (const std::size_t texels : {1u, 2u})
            result.push_back(
                {"window_" + std::to_string(guard) + "_texels_" + std::to_string(texels),
                 "windows " + std::to_string(guard) + ", layers " + std::to_string(texels) + " times a tile",
                 [=](double tile, double speed) {
                     return error(std::size_t(std::lround(tile)), guard, texels, speed);
                 }});
    return result;
}

const registered<sweep> entry{
    sweep{.id = "layer_tile",
          .label = "Size of a tile",
          .order = 255,
          .text = "Two sheets of stripes, one behind the other, move in directions of their own. Pixels behind them "
                  "are static in the "
                  "map or follow the first sheet. Windows and layers are some times as long as a tile.",
          .x = {"tile", "side of a tile in texels", scale::log, 2, 16, 4},
          .y = {"speed", "motion in texels", scale::log, 0.5, 32, 7},
          .error_label = "root mean square error",
          .threshold = 0.1,
          .layers = layers}};

} // namespace

} // namespace gnomon::evaluation::layer_tile
