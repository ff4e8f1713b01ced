// Moment shadow maps of six moments in floats.
#include "filterable.hpp"

#include <gnomon/storage/formats.hpp>

namespace gnomon::evaluation {

namespace {

const registered<filterable<moments6_float>> entry{
    method_facts{.id = "msm6_float", .family = "msm6", .label = "MSM6 192 bit", .order = 30},
    device_form{{{"R32G32B32A32Sfloat", 4}, {"R32G32Sfloat", 2}},
                "moments6_float_encode",
                "moments6_float_filtered_intensity"}};

} // namespace

} // namespace gnomon::evaluation
