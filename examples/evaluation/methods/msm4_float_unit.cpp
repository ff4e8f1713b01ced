// Moments of depth in [0, 1], as moment shadow maps had them before signed depth (Peters et al. 2017, Figure 4d).
#include "filterable.hpp"

#include <gnomon/comparators/hamburger_cholesky.h>
#include <gnomon/storage/formats.hpp>

namespace gnomon::evaluation {

namespace {

struct unit_depth : moments4_float {
    template <class Real> static channels4<Real> from_depth(Real z)
    {
        return moments4_float_encode(Real(0.5f) * z + Real(0.5f));
    }
    template <class Real> static Real filtered_intensity(const channels4<Real>& channels, Real z_f)
    {
        moments4<Real> b = moments4_from_channels(channels);
        for (Real* moment : {&b.b1, &b.b2, &b.b3, &b.b4})
            *moment = *moment + literal<Real>(2e-6) * (Real(0.5f) - *moment);
        return hamburger4_cholesky_intensity(b, Real(0.5f) * z_f + Real(0.5f));
    }
};

const registered<filterable<unit_depth>> entry{
    method_facts{.id = "msm4_float_unit", .family = "msm4", .label = "MSM 128 bit, depth in [0, 1]", .order = 50}};

} // namespace

} // namespace gnomon::evaluation
