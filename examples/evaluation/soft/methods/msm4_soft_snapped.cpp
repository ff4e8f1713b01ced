// The same without interpolation: the filter rectangle snaps to the grid of texels (Peters et al. 2017, Sec. 4.4).
#include "moments4.hpp"

namespace gnomon::evaluation {

namespace {

const registered<summed_method<moments4_kernels, look_up_options{.interpolated = false}>> entry{method_facts{
    .id = "msm4_soft_snapped", .family = "msm4", .label = "MSM soft, 4 moments, not interpolated", .order = 210}};

} // namespace

} // namespace gnomon::evaluation
