// Every receiver is filtered: no look-up ends with the search.
#include "moments4.hpp"

namespace gnomon::evaluation {

namespace {

const registered<summed_method<moments4_kernels, look_up_options{.skips_umbra = false}>> entry{
    method_facts{.id = "msm4_soft_whole", .family = "msm4", .label = "MSM soft, 4 moments, no skip", .order = 230}};

} // namespace

} // namespace gnomon::evaluation
