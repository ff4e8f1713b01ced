// Moment shadow maps of four moments in floats as Peters et al. 2017 have them: Algorithm 1 with the bias of Figure 4f.
#include "filterable.hpp"

#include <gnomon/comparators/hamburger_cholesky.h>
#include <gnomon/storage/formats.hpp>

namespace gnomon::evaluation {

namespace {

struct paper_bias_float : moments4_float {
    template <class Real> static Real filtered_intensity(const channels4<Real>& channels, Real z_f)
    {
        const moments4<Real> biased =
            moments4_add_bias(moments4_from_channels(channels), literal<Real>(bias4_raw_paper_b2),
                              literal<Real>(bias4_raw_paper_b4), literal<Real>(3e-7));
        return hamburger4_cholesky_intensity(biased, z_f);
    }
};

const registered<filterable<paper_bias_float>> entry{
    method_facts{.id = "msm4_float_paper", .family = "msm4", .label = "MSM 128 bit (paper)", .order = 60}};

} // namespace

} // namespace gnomon::evaluation
