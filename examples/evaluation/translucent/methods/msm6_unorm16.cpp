// Moment shadow maps with translucent occluders: six moments in 96 bits.
#include "evaluation/translucent/blended.hpp"
#include "rules.hpp"

namespace gnomon::evaluation {

namespace {

const registered<blended<moments_rule<moments6_unorm16>>> entry{
    method_facts{.id = "msm6_unorm16_blended", .family = "msm6", .label = "MSM6 96 bit", .order = 120}};

} // namespace

} // namespace gnomon::evaluation
