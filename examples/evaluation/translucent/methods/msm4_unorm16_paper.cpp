// Moment shadow maps with translucent occluders as Peters et al. 2017 have them in Figure 5d: Algorithm 1 and a bias that
// does not grow with the roundings of blends.
#include "evaluation/translucent/blended.hpp"
#include "rules.hpp"

#include <gnomon/comparators/hamburger_cholesky.h>

namespace gnomon::evaluation {

namespace {

struct paper_rule {
    using format = moments4_unorm16;
    template <class Real> using channels = format::channels<Real>;

    template <class Real> static moments4<Real> biased(const channels<Real>& c)
    {
        return moments4_add_bias(theta4_inverse(c), literal<Real>(bias4_theta_paper_b2),
                                 literal<Real>(bias4_theta_paper_b4), literal<Real>(6e-5));
    }
    template <class Real> static Real lower(const channels<Real>& c, Real, Real z_f)
    {
        return hamburger4_cholesky_intensity(biased(c), z_f);
    }
    template <class Real> static hamburger_bounds<Real> bounds(const channels<Real>& c, Real, Real z_f)
    {
        return hamburger4_bounds(hankel4_from_moments(biased(c)), z_f);
    }
};

const registered<blended<paper_rule>> entry{
    method_facts{.id = "msm4_unorm16_paper_blended", .family = "msm4", .label = "MSM 64 bit (paper)", .order = 110}};

} // namespace

} // namespace gnomon::evaluation
