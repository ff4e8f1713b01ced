// Moment shadow maps with translucent occluders: four moments in 64 bits.
#include "evaluation/translucent/blended.hpp"
#include "rules.hpp"

namespace gnomon::evaluation {

namespace {

const registered<blended<moments_rule<moments4_unorm16>>> entry{
    method_facts{.id = "msm4_unorm16_blended", .family = "msm4", .label = "MSM 64 bit", .order = 120}};

} // namespace

} // namespace gnomon::evaluation
