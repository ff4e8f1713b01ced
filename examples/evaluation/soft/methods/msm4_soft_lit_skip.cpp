// Receivers that the search finds fully lit are not filtered, which Peters et al. 2017, Sec. 4.5, reject: the lower bound of a search region is often 0 where the filter region is not lit.
#include "moments4.hpp"

namespace gnomon::evaluation {

namespace {

const registered<summed_method<moments4_kernels, look_up_options{.skips_lit = true}>> entry{method_facts{
    .id = "msm4_soft_lit_skip", .family = "msm4", .label = "MSM soft, 4 moments, skip of the lit", .order = 240}};

} // namespace

} // namespace gnomon::evaluation
