// A receiver close behind a surface, with a second surface far behind both: contact shadows.
#include "region.hpp"
#include "sweep.hpp"

#include <array>

namespace gnomon::evaluation::near_receiver {

namespace {

double error(const filterable_method& m, double distance, double weight)
{
    constexpr float occluder = -0.4f;
    return leak_at(m, std::array{layer{occluder, float(weight)}, layer{0.8f, float(1 - weight)}},
                   float(double(occluder) + distance));
}

const registered<sweep> entry{
    sweep{.id = "near_receiver",
          .label = "Receiver close to a surface",
          .order = 30,
          .text = "The receiver lies close behind a surface that covers a share of the filter region; the rest of the "
                  "region is far "
                  "behind the receiver. The exact intensity is that share.",
          .x = {"distance", "distance of the receiver from the surface", scale::log, 1e-4, 1.1, 32},
          .y = {"weight", "share of the surface", scale::linear, 0.05, 0.95, 16},
          .error_label = "leak",
          .threshold = 0.1,
          .layers = [] { return layers_of_methods(error); }}};

} // namespace

} // namespace gnomon::evaluation::near_receiver
