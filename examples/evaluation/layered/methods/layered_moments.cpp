// Layers by four moments.
#include "filtered_layers.hpp"

namespace gnomon::evaluation {

namespace {

const registered<filtered_layers<layer_moments4_float>> entry{
    method_facts{.id = "layered_moments", .family = "layers", .label = "layers, four moments", .order = 20},
    std::vector<layered_variant>{{.comparisons = {equal_input}}}};

} // namespace

} // namespace gnomon::evaluation
