// Two surfaces and a receiver on the farther one: how a method leaks as the surfaces approach one another.
#include "region.hpp"
#include "sweep.hpp"

#include <array>

namespace gnomon::evaluation::two_surfaces {

namespace {

double error(const filterable_method& m, double distance, double weight)
{
    constexpr float receiver = 0.95f;
    return leak_at(
        m, std::array{layer{float(double(receiver) - distance), float(weight)}, layer{receiver, float(1 - weight)}},
        receiver);
}

const registered<sweep> entry{sweep{
    .id = "two_surfaces",
    .label = "Two surfaces",
    .order = 10,
    .text =
        "A nearer surface covers a share of the filter region, and the receiver lies on the farther surface. The exact "
        "intensity is that share. A method fails where too little of it is left.",
    .x = {"distance", "distance of the surfaces (signed depth)", scale::log, 1e-4, 1.9, 32},
    .y = {"weight", "share of the nearer surface", scale::linear, 0.05, 0.95, 16},
    .error_label = "leak",
    .threshold = 0.1,
    .layers = [] { return layers_of_methods(error); }}};

} // namespace

} // namespace gnomon::evaluation::two_surfaces
