// Exponential variance shadow maps in floats (Lauritzen & McCool 2008).
#include "filterable.hpp"

#include <gnomon/storage/formats.hpp>

namespace gnomon::evaluation {

namespace {

const registered<filterable<exponential_variance_float>> entry{
    method_facts{.id = "evsm_float", .family = "evsm", .label = "EVSM 128 bit", .order = 20},
    device_form{
        {{"R32G32B32A32Sfloat", 4}}, "exponential_variance_float_encode", "exponential_variance_float_intensity"}};

} // namespace

} // namespace gnomon::evaluation
