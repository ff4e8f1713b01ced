// Resolved ranges, those of one mesh joined that follow one another on nearly one line.
#include "rasterized_ranges.hpp"

namespace gnomon::evaluation {

namespace {

const registered<rasterized_ranges> entry{
    method_facts{.id = "joined_ranges", .family = "resolved_ranges", .label = "resolved ranges, joined", .order = 10},
    renderer::range_options{.resolved = true, .depth_tolerance = depth_tolerance, .joining = depth_tolerance},
    range_method_facts{.variants = {{.receivers = {"analytic"}, .tag = "surfaces", .pictured = false}}}};

} // namespace

} // namespace gnomon::evaluation
