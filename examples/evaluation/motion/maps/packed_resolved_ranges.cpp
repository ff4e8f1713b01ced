#include "packed_ranges.hpp"

namespace gnomon::evaluation {

namespace {

const registered<family> packed_resolved{
    family{.id = "packed_resolved_ranges", .label = "resolved ranges, packed", .order = 155, .colour = "#17becf"}};

const registered<packed_ranges> entry{
    method_facts{
        .id = "packed_resolved_ranges", .family = "packed_resolved_ranges", .label = "resolved ranges, packed"},
    "resolved_ranges"};

} // namespace

} // namespace gnomon::evaluation
