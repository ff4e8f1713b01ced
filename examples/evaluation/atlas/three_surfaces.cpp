// Three surfaces and a receiver on the farthest one: more surfaces than two moments can tell apart.
#include "region.hpp"
#include "sweep.hpp"

#include <array>

namespace gnomon::evaluation::three_surfaces {

namespace {

double error(const filterable_method& m, double first_gap, double second_gap)
{
    constexpr double receiver = 0.95;
    return leak_at(m,
                   std::array{layer{float(receiver - second_gap - first_gap), 0.25f},
                              layer{float(receiver - second_gap), 0.25f}, layer{float(receiver), 0.5f}},
                   float(receiver));
}

const registered<sweep> entry{sweep{
    .id = "three_surfaces",
    .label = "Three surfaces",
    .order = 20,
    .text =
        "Two surfaces cover a quarter of the filter region each, and the receiver lies on a third one behind them. The "
        "exact intensity is a half.",
    .x = {"first_gap", "distance from the first surface to the second", scale::log, 1e-3, 0.95, 32},
    .y = {"second_gap", "distance from the second to the third", scale::log, 1e-3, 0.95, 16},
    .error_label = "leak",
    .threshold = 0.1,
    .layers = [] { return layers_of_methods(error); }}};

} // namespace

} // namespace gnomon::evaluation::three_surfaces
