// Moment shadow maps of four moments in half floats.
#include "filterable.hpp"

#include <gnomon/storage/formats.hpp>

namespace gnomon::evaluation {

namespace {

const registered<filterable<moments4_half>> entry{
    method_facts{.id = "msm4_half", .family = "msm4", .label = "MSM 64 bit half", .order = 40}};

} // namespace

} // namespace gnomon::evaluation
