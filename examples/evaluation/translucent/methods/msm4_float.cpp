// Moment shadow maps with translucent occluders: four moments in floats.
#include "evaluation/translucent/blended.hpp"
#include "rules.hpp"

namespace gnomon::evaluation {

namespace {

const registered<blended<moments_rule<moments4_float>>> entry{
    method_facts{.id = "msm4_float_blended", .family = "msm4", .label = "MSM 128 bit", .order = 140}};

} // namespace

} // namespace gnomon::evaluation
