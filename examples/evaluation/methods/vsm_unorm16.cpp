// Variance shadow maps (Donnelly & Lauritzen 2006).
#include "filterable.hpp"

#include <gnomon/storage/formats.hpp>

namespace gnomon::evaluation {

namespace {

const registered<family> vsm{family{.id = "vsm", .label = "variance shadow maps", .order = 20, .colour = "#8c6d31"}};

const registered<filterable<variance_unorm16>> entry{
    method_facts{.id = "vsm_unorm16", .family = "vsm", .label = "VSM 32 bit", .order = 10},
    device_form{{{"R16G16Unorm", 2}}, "variance_unorm16_encode", "variance_unorm16_intensity"}};

} // namespace

} // namespace gnomon::evaluation
