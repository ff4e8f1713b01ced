// Moment shadow maps with translucent occluders: six moments in 64 bits, of which 60 are used.
#include "evaluation/translucent/blended.hpp"
#include "rules.hpp"

namespace gnomon::evaluation {

namespace {

const registered<blended<moments_rule<moments6_unorm10>>> entry{
    method_facts{.id = "msm6_unorm10_blended", .family = "msm6", .label = "MSM6 60 bit", .order = 110}};

} // namespace

} // namespace gnomon::evaluation
