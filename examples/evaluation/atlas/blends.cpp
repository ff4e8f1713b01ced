// Layers of fog that are blended into a map: each blend rounds to the format, and thin layers no longer change a code.
#include "fog.hpp"
#include "sweep.hpp"

#include <cstddef>
#include <vector>

namespace gnomon::evaluation::blends {

namespace {

double error(const fog_map& m, double count, double opacity)
{
    const auto each = float(opacity);
    return fog_error(m, std::vector(std::size_t(count), each), each);
}

const registered<sweep> entry{sweep{
    .id = "blends",
    .label = "Blended layers",
    .order = 80,
    .text = "Layers of equal opacity fill a slab in front of an opaque surface, and are blended into a texel from "
            "back to front, each result stored in the format. A method fails where the shadow of the slab on the "
            "surface is 0.1 too light, or any receiver is 0.02 too dark. Each point is the worst of slabs from "
            "thin to thick.",
    .x = {"layers", "layers", scale::log, 1, 1000, 25},
    .y = {"opacity", "opacity of a layer", scale::log, 1e-3, 0.9, 16},
    .error_label = "error in multiples of what is allowed",
    .threshold = 1,
    .layers = [] { return layers_of_fog_maps(error); }}};

} // namespace

} // namespace gnomon::evaluation::blends
