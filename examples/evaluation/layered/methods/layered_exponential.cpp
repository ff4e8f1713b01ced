// Layers by an exponential of depth.
#include "filtered_layers.hpp"

namespace gnomon::evaluation {

namespace {

const registered<filtered_layers<layer_exponential_float>> entry{
    method_facts{.id = "layered_exponential", .family = "layers", .label = "layers, exponential", .order = 30},
    std::vector<layered_variant>{{.comparisons = {equal_input}}}};

} // namespace

} // namespace gnomon::evaluation
