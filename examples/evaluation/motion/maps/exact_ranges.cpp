// All ranges, exact by edge functions in time.
#include "rasterized_ranges.hpp"

namespace gnomon::evaluation {

namespace {

const registered<family> exact{
    family{.id = "exact_ranges", .label = "exact ranges", .order = 130, .colour = "#ff7f0e"}};

const registered<rasterized_ranges> entry{
    method_facts{.id = "exact_ranges", .family = "exact_ranges", .label = "exact ranges"},
    renderer::range_options{.depth_tolerance = depth_tolerance},
    range_method_facts{.variants = {{.receivers = {"stochastic"}}}, .shared = true, .curve = true}};

} // namespace

} // namespace gnomon::evaluation
