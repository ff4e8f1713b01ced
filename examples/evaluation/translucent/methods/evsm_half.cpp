// Exponential variance shadow maps with translucent occluders in half floats (Peters et al. 2017, Figure 5b).
#include "exponential_variance_rule.hpp"

namespace gnomon::evaluation {

namespace {

const registered<blended<exponential_variance_rule<exponential_variance_half>>> entry{
    method_facts{.id = "evsm_half_blended", .family = "evsm", .label = "EVSM 64 bit", .order = 110}};

} // namespace

} // namespace gnomon::evaluation
