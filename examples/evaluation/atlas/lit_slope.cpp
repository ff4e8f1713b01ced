// A lit plane that is seen at a slope, under filters of growing width, with the depth bias that percentage-closer
// filtering of one texel needs: wider filters reach depths that the bias does not cover.
#include "region.hpp"
#include "sweep.hpp"

#include <vector>

namespace gnomon::evaluation::lit_slope {

namespace {

std::vector<layer> plane(double slope, double half_width)
{
    const int taps = 2 * int(half_width) + 1;
    std::vector<layer> result;
    for (int k = 0; k < taps; ++k) result.push_back({float(slope * (k - int(half_width))), float(1.0 / taps)});
    return result;
}

float biased_receiver(double slope) { return -float(slope); }

std::vector<sweep_layer> layers()
{
    std::vector<sweep_layer> result =
        layers_of_methods([](const filterable_method& m, double slope, double half_width) {
            return double(m.intensity(filtered(m, plane(slope, half_width)), biased_receiver(slope)));
        });
    for (const method* m : methods_in_order())
        if (m->id == "pcf")
            result.insert(result.begin(), {m->id, m->label, [](double slope, double half_width) {
                                               return exact_intensity(plane(slope, half_width), biased_receiver(slope));
                                           }});
    return result;
}

const registered<sweep> entry{sweep{.id = "lit_slope",
                                    .label = "Slope of a lit plane",
                                    .order = 50,
                                    .text = "A lit plane fills the filter region; its depth changes from texel to "
                                            "texel. The receiver lies on the plane, nearer "
                                            "by the depth bias of one texel. Any intensity darkens a lit surface.",
                                    .x = {"slope", "change of depth per texel", scale::log, 1e-5, 0.05, 32},
                                    .y = {"half_width", "half width of the filter in texels", scale::linear, 1, 16, 16},
                                    .error_label = "shadow on a lit plane",
                                    .threshold = 0.1,
                                    .layers = layers}};

} // namespace

} // namespace gnomon::evaluation::lit_slope
