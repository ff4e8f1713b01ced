// The bound on the shadow that knows that depths lie in [-1, 1].
#include "moments4.hpp"

#include <gnomon/storage/moments4_summed_within.h>

namespace gnomon::evaluation {

namespace {

struct within_kernels : moments4_kernels {
    template <class Real> static Real shadow(const channels4<Real>& c, Real most_texels, Real z_f)
    {
        return moments4_summed_intensity_within(c, most_texels, z_f);
    }
};

const registered<summed_method<within_kernels, look_up_options{}>> entry{
    method_facts{.id = "msm4_soft_within", .family = "msm4", .label = "MSM soft, 4 moments of [-1, 1]", .order = 270}};

} // namespace

} // namespace gnomon::evaluation
