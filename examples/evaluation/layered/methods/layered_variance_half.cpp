// Layers by two moments in half floats.
#include "filtered_layers.hpp"

namespace gnomon::evaluation {

namespace {

const registered<filtered_layers<layer_variance_half>> entry{
    method_facts{.id = "layered_variance_half", .family = "layers", .label = "layers, variance in halves", .order = 10},
    std::vector<layered_variant>{{.comparisons = {of_settings}}}};

} // namespace

} // namespace gnomon::evaluation
