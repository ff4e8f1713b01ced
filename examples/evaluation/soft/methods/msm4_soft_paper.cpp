// Moment soft shadow mapping of four moments with the bias of Peters et al. 2017, Sec. 4.2, whatever the size of the search.
#include "evaluation/soft/look_up.hpp"
#include "moments4.hpp"

namespace gnomon::evaluation {

namespace {

struct paper_bias : moments4_kernels {
    template <class Real> static hankel4<Real> region(const channels4<Real>& c, Real)
    {
        return hankel4_constant_bias(theta4_inverse(c), literal<Real>(bias4_theta_paper_b2),
                                     literal<Real>(bias4_theta_paper_b4), literal<Real>(6e-7));
    }
    template <class Real> static Real shadow(const channels4<Real>& c, Real most_texels, Real z_f)
    {
        return hamburger4_lower(region(c, most_texels), z_f);
    }
};

const registered<summed_method<paper_bias, look_up_options{}>> entry{
    method_facts{.id = "msm4_soft_paper", .family = "msm4", .label = "MSM soft, 4 moments (paper)", .order = 190}};

} // namespace

} // namespace gnomon::evaluation
