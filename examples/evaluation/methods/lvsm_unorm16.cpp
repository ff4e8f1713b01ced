// Layered variance shadow maps of four layers (Lauritzen & McCool 2008).
#include "filterable.hpp"

#include <gnomon/storage/formats.hpp>

namespace gnomon::evaluation {

namespace {

const registered<family> lvsm{
    family{.id = "lvsm", .label = "layered variance shadow maps", .order = 30, .colour = "#c49a4a"}};

const registered<filterable<layered_variance_unorm16>> entry{
    method_facts{.id = "lvsm_unorm16", .family = "lvsm", .label = "LVSM 128 bit", .order = 10}};

} // namespace

} // namespace gnomon::evaluation
