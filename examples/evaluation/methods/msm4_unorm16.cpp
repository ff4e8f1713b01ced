// Moment shadow maps of four moments in 64 bits, with the certified bound of the library.
#include "filterable.hpp"

#include <gnomon/storage/formats.hpp>

namespace gnomon::evaluation {

namespace {

const registered<family> msm4{
    family{.id = "msm4", .label = "moment shadow maps of four moments", .order = 70, .colour = "#1f77b4"}};

const registered<filterable<moments4_unorm16>> entry{
    method_facts{.id = "msm4_unorm16", .family = "msm4", .label = "MSM 64 bit", .order = 20},
    device_form{{{"R16G16B16A16Unorm", 4}}, "moments4_unorm16_encode", "moments4_unorm16_filtered_intensity"}};

} // namespace

} // namespace gnomon::evaluation
