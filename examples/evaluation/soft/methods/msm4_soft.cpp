// Moment soft shadow mapping of four moments, interpolated, with the umbra skip.
#include "moments4.hpp"

namespace gnomon::evaluation {

namespace {

const registered<summed_method<moments4_kernels, look_up_options{}>> entry{
    method_facts{.id = "msm4_soft", .family = "msm4", .label = "MSM soft, 4 moments", .order = 200}};

} // namespace

} // namespace gnomon::evaluation
