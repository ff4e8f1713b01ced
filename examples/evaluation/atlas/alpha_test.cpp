// Fog whose layers have an uneven texture, with an alpha test: fragments of less than an opacity are not drawn, so blends
// round less often, and the fog gets thinner.
#include "fog.hpp"
#include "sweep.hpp"

#include <cmath>
#include <vector>

namespace gnomon::evaluation::alpha_test {

namespace {

constexpr double absorbance = 1; // of all layers: the fog lets through a share of 1/e

// The texture of each layer is an even share of absorbance from 0 to twice the mean, in a sequence without order.
std::vector<float> texture(int count)
{
    std::vector<float> result;
    for (int i = 0; i < count; ++i) {
        const double share = std::fmod(0.6180339887 * (i + 0.5), 1);
        result.push_back(float(-std::expm1(-2 * share * absorbance / count)));
    }
    return result;
}

double error(const fog_map& m, double least_opacity, double count)
{
    return fog_error(m, texture(int(count)), float(least_opacity));
}

const registered<sweep> entry{
    sweep{.id = "alpha_test",
          .label = "Alpha test of blended layers",
          .order = 90,
          .text = "Layers with a texture let a share of 1/e through together: the more there are, the thinner each is. "
                  "Fragments of less than an opacity are not drawn. On the left blends round too often, on the right "
                  "too much of the fog is missing. A method fails as under blended layers.",
          .x = {"least_opacity", "least opacity that is drawn", scale::log, 1e-4, 0.3, 24},
          .y = {"layers", "layers", scale::log, 3, 1000, 16},
          .error_label = "error in multiples of what is allowed",
          .threshold = 1,
          .layers = [] { return layers_of_fog_maps(error); }}};

} // namespace

} // namespace gnomon::evaluation::alpha_test
