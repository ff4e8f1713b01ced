// Resolved ranges without backdrops: without what is behind all else in a texel while the shutter is open.
#include "rasterized_ranges.hpp"

namespace gnomon::evaluation {

namespace {

const registered<family> casters{
    family{.id = "caster_ranges", .label = "caster ranges", .order = 160, .colour = "#2ca02c"}};

const registered<rasterized_ranges> entry{
    method_facts{.id = "caster_ranges", .family = "caster_ranges", .label = "caster ranges"},
    renderer::range_options{.resolved = true, .backdrops = false, .depth_tolerance = depth_tolerance},
    range_method_facts{
        .variants = {{.parameters = {{"totals", 1}}, .receivers = {"analytic"}}}, .shared = true, .curve = true}};

} // namespace

} // namespace gnomon::evaluation
