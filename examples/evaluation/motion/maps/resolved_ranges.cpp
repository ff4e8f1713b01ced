// Exact ranges resolved to what is in front when.
#include "rasterized_ranges.hpp"

namespace gnomon::evaluation {

namespace {

const registered<family> resolved{
    family{.id = "resolved_ranges", .label = "resolved ranges", .order = 150, .colour = "#1f77b4"}};

const registered<rasterized_ranges> entry{
    method_facts{.id = "resolved_ranges", .family = "resolved_ranges", .label = "resolved ranges"},
    renderer::range_options{.resolved = true, .depth_tolerance = depth_tolerance},
    range_method_facts{
        .variants =
            {{.receivers = {"stochastic", "static", "sampled", "semi_analytic", "analytic"}},
             {.parameters = {{"surfaces", 1}}, .receivers = {"analytic"}, .tag = "surfaces", .pictured = false}},
        .shared = true,
        .curve = true}};

} // namespace

} // namespace gnomon::evaluation
