// View rays along the inner side of a wall: the map has its outer side, so a thin wall is close to the ray, and light leaks.
#include "view_ray.hpp"

#include <array>

namespace gnomon::evaluation::thin_walls {

namespace {

double error(const row_intensity& intensity, double thickness, double windows)
{
    constexpr float ray = 0, ground = 0.5f;
    return error_of_row(
        intensity, std::array{layer{float(-thickness), float(1 - windows)}, layer{ground, float(windows)}}, ray, 0.5f);
}

const registered<sweep> entry{
    sweep{.id = "thin_walls",
          .label = "Thin walls",
          .order = 160,
          .text = "A ray runs along the inner side of a wall with windows. The map has the outer side of the wall, and "
                  "the ground through the windows. The ray takes the middle of the bounds.",
          .x = {"thickness", "thickness of the wall", scale::log, 1e-4, 0.75, 32},
          .y = {"windows", "share of the windows", scale::linear, 0, 0.9, 16},
          .error_label = "error",
          .threshold = 0.1,
          .layers = [] { return layers_of_rows(error); }}};

} // namespace

} // namespace gnomon::evaluation::thin_walls
