// Moment shadow maps with translucent occluders: four moments in half floats.
#include "evaluation/translucent/blended.hpp"
#include "rules.hpp"

namespace gnomon::evaluation {

namespace {

const registered<blended<moments_rule<moments4_half>>> entry{
    method_facts{.id = "msm4_half_blended", .family = "msm4", .label = "MSM 64 bit half", .order = 130}};

} // namespace

} // namespace gnomon::evaluation
