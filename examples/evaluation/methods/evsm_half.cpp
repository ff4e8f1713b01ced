// Exponential variance shadow maps in half floats (Lauritzen & McCool 2008).
#include "filterable.hpp"

#include <gnomon/storage/formats.hpp>

namespace gnomon::evaluation {

namespace {

const registered<family> evsm{
    family{.id = "evsm", .label = "exponential variance shadow maps", .order = 50, .colour = "#d62728"}};

const registered<filterable<exponential_variance_half>> entry{
    method_facts{.id = "evsm_half", .family = "evsm", .label = "EVSM 64 bit", .order = 10},
    device_form{
        {{"R16G16B16A16Sfloat", 4}}, "exponential_variance_half_encode", "exponential_variance_half_intensity"}};

} // namespace

} // namespace gnomon::evaluation
