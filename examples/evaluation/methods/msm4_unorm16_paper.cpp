// Moment shadow maps of four moments in 64 bits as Peters et al. 2017 have them: Algorithm 1 with the bias of Figure 4b.
#include "filterable.hpp"

#include <gnomon/comparators/hamburger_cholesky.h>
#include <gnomon/storage/formats.hpp>

namespace gnomon::evaluation {

namespace {

struct paper_bias_unorm16 : moments4_unorm16 {
    template <class Real> static Real filtered_intensity(const channels4<Real>& channels, Real z_f)
    {
        const moments4<Real> biased = moments4_add_bias(theta4_inverse(channels), literal<Real>(bias4_theta_paper_b2),
                                                        literal<Real>(bias4_theta_paper_b4), literal<Real>(6e-5));
        return hamburger4_cholesky_intensity(biased, z_f);
    }
};

const registered<filterable<paper_bias_unorm16>> entry{
    method_facts{.id = "msm4_unorm16_paper", .family = "msm4", .label = "MSM 64 bit (paper)", .order = 10}};

} // namespace

} // namespace gnomon::evaluation
