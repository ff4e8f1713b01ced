// Exponential variance shadow maps with translucent occluders in floats (Peters et al. 2017, Figure 5c).
#include "exponential_variance_rule.hpp"

namespace gnomon::evaluation {

namespace {

const registered<blended<exponential_variance_rule<exponential_variance_float>>> entry{
    method_facts{.id = "evsm_float_blended", .family = "evsm", .label = "EVSM 128 bit", .order = 120}};

} // namespace

} // namespace gnomon::evaluation
