// Convolution shadow maps of 16 terms (Annen et al. 2007).
#include "filterable.hpp"

#include <gnomon/storage/formats.hpp>

namespace gnomon::evaluation {

namespace {

const registered<family> csm{family{.id = "csm", .label = "convolution shadow maps", .order = 60, .colour = "#7f7f7f"}};

const registered<filterable<convolution_unorm8>> entry{
    method_facts{.id = "csm_unorm8", .family = "csm", .label = "CSM 256 bit", .order = 10}};

} // namespace

} // namespace gnomon::evaluation
