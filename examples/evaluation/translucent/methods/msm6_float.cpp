// Moment shadow maps with translucent occluders: six moments in floats.
#include "evaluation/translucent/blended.hpp"
#include "rules.hpp"

namespace gnomon::evaluation {

namespace {

const registered<blended<moments_rule<moments6_float>>> entry{
    method_facts{.id = "msm6_float_blended", .family = "msm6", .label = "MSM6 192 bit", .order = 130}};

} // namespace

} // namespace gnomon::evaluation
