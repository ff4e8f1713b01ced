#include "packed_ranges.hpp"

namespace gnomon::evaluation {

namespace {

const registered<family> packed_casters{
    family{.id = "packed_caster_ranges", .label = "caster ranges, packed", .order = 165, .colour = "#8c6d31"}};

const registered<packed_ranges> entry{
    method_facts{.id = "packed_caster_ranges", .family = "packed_caster_ranges", .label = "caster ranges, packed"},
    "caster_ranges"};

} // namespace

} // namespace gnomon::evaluation
