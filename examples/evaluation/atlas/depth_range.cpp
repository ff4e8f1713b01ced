// A scene that uses little of the range of depth: near and far plane far apart, or a light far away.
#include "region.hpp"
#include "sweep.hpp"

#include <array>

namespace gnomon::evaluation::depth_range {

namespace {

double error(const filterable_method& m, double range, double weight)
{
    constexpr double middle = 0.3;
    const float receiver = float(middle + range / 2);
    return leak_at(m,
                   std::array{layer{float(middle - range / 2), float(weight / 2)},
                              layer{float(middle), float(weight / 2)}, layer{receiver, float(1 - weight)}},
                   receiver);
}

const registered<sweep> entry{sweep{.id = "depth_range",
                                    .label = "Range of depth in use",
                                    .order = 40,
                                    .text = "Three surfaces at even distances use a part of the range of depth, and "
                                            "the receiver lies on the farthest one. The "
                                            "exact intensity is the share of the other two.",
                                    .x = {"range", "part of the range of depth in use", scale::log, 1e-6, 1, 32},
                                    .y = {"weight", "share of the two nearer surfaces", scale::linear, 0.05, 0.95, 16},
                                    .error_label = "leak",
                                    .threshold = 0.1,
                                    .layers = [] { return layers_of_methods(error); }}};

} // namespace

} // namespace gnomon::evaluation::depth_range
