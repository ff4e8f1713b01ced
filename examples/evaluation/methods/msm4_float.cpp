// Moment shadow maps of four moments in floats.
#include "filterable.hpp"

#include <gnomon/storage/formats.hpp>

namespace gnomon::evaluation {

namespace {

const registered<filterable<moments4_float>> entry{
    method_facts{.id = "msm4_float", .family = "msm4", .label = "MSM 128 bit", .order = 70},
    device_form{{{"R32G32B32A32Sfloat", 4}}, "moments4_float_encode", "moments4_float_filtered_intensity"}};

} // namespace

} // namespace gnomon::evaluation
