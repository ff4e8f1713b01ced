// Layers by two moments, as in the paper, with its settings for two sizes of maps, its ablations, and what goes beyond.
#include "filtered_layers.hpp"

namespace gnomon::evaluation {

namespace {

const registered<filtered_layers<layer_variance_float>> entry{
    method_facts{.id = usual_layers, .family = "layers", .label = "layers, variance"},
    std::vector<layered_variant>{
        {.comparisons = {equal_input}},
        {.parameters = {{"layers", 3}}, .label = "of 3 layers", .comparisons = {of_settings}},
        {.parameters = {{"layers", 2}}, .label = "of 2 layers", .comparisons = {of_settings}},
        {.parameters = {{"layers", 1}}, .label = "of 1 layer", .comparisons = {of_settings}},
        {.parameters = {{"layers", 1}, {"division", 8}},
         .label = "of 1 layer, divided by motion",
         .comparisons = {of_settings}},
        {.parameters = {{"division", 8}},
         .label = "divided by motion",
         .comparisons = {of_settings},
         .scene = "random_cubes"},
        {.parameters = {{"neighbour", 0}}, .label = "without neighbours", .comparisons = {of_settings}},
        {.parameters = {{"v_filter", 0}}, .label = "without the filter across", .comparisons = {of_settings}},
        {.parameters = {{"neighbour", 2}}, .label = "with neighbours blended", .comparisons = {of_settings}},
        {.parameters = {{"even", 0}}, .label = "with the weights of the paper", .comparisons = {of_settings}},
        {.parameters = {{"even_times", 1}}, .label = "of even times", .comparisons = {of_settings}},
        {.parameters = {{"limit", 0.25}},
         .label = "with a bias of up to an eighth of all depths",
         .comparisons = {of_settings},
         .scene = "tree_in_moving_light"},
        {.parameters = {{"texels", 16}},
         .label = "of 16 texels",
         .comparisons = {of_settings},
         .scene = "tree_in_moving_light"},
        {.parameters = {{"widen", 1}}, .label = "widened by the spread", .comparisons = {of_settings}},
        {.parameters = {{"tile", 8}, {"guard", 16}, {"texels", 8}, {"layers", 2}, {"neighbour", 0}},
         .label = "fast preset",
         .comparisons = {of_settings}},
        {.parameters = {{"scale", 2}, {"tile", 8}, {"guard", 16}, {"texels", 16}},
         .label = "of twice the map, tiles of 8",
         .comparisons = {of_settings}},
        {.parameters = {{"scale", 2}}, .label = "of twice the map", .comparisons = {of_settings}},
        {.parameters = {{"scale", 0.5}}, .label = "of half the map", .comparisons = {of_settings}}}};

} // namespace

} // namespace gnomon::evaluation
