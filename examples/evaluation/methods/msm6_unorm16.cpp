// Moment shadow maps of six moments in 96 bits.
#include "filterable.hpp"

#include <gnomon/storage/formats.hpp>

namespace gnomon::evaluation {

namespace {

const registered<filterable<moments6_unorm16>> entry{
    method_facts{.id = "msm6_unorm16", .family = "msm6", .label = "MSM6 96 bit", .order = 20},
    device_form{{{"R16G16B16A16Unorm", 4}, {"R16G16Unorm", 2}},
                "moments6_unorm16_encode",
                "moments6_unorm16_filtered_intensity"}};

} // namespace

} // namespace gnomon::evaluation
