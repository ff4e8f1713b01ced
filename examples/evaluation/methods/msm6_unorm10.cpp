// Moment shadow maps of six moments in 64 bits, of which 60 are used.
#include "filterable.hpp"

#include <gnomon/storage/formats.hpp>

namespace gnomon::evaluation {

namespace {

const registered<family> msm6{
    family{.id = "msm6", .label = "moment shadow maps of six moments", .order = 80, .colour = "#2ca02c"}};

const registered<filterable<moments6_unorm10>> entry{
    method_facts{.id = "msm6_unorm10", .family = "msm6", .label = "MSM6 60 bit", .order = 10},
    device_form{{{"A2B10G10R10UnormPack32", 3}, {"A2B10G10R10UnormPack32", 3}},
                "moments6_unorm10_encode",
                "moments6_unorm10_filtered_intensity"}};

} // namespace

} // namespace gnomon::evaluation
