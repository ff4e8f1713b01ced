// The filter rectangle snaps to the grid of texels at random, which Peters et al. 2017, Sec. 4.4, reject for its noise.
#include "moments4.hpp"

namespace gnomon::evaluation {

namespace {

const registered<summed_method<moments4_kernels, look_up_options{.dithers = true}>> entry{
    method_facts{.id = "msm4_soft_dithered", .family = "msm4", .label = "MSM soft, 4 moments, dithered", .order = 220}};

} // namespace

} // namespace gnomon::evaluation
