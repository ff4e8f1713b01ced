// Moments of depth in [0, 1], as moment shadow maps had them before signed depth (Peters et al. 2017, Figure 4d).
#include "filterable.hpp"

#include <gnomon/comparators/hamburger_cholesky.h>
#include <gnomon/storage/moments_formats.hpp>

namespace gnomon::evaluation {

namespace {

struct unit_depth : moments4_float {
    static moments moments_of_depth(float z) { return moments4_from_depth(0.5f * z + 0.5f); }
    template <class Real> static Real filtered_intensity(moments4<Real> channels, Real z_f)
    {
        for (Real* moment : {&channels.b1, &channels.b2, &channels.b3, &channels.b4})
            *moment = *moment + literal<Real>(2e-6) * (Real(0.5f) - *moment);
        return hamburger4_cholesky_intensity(channels, Real(0.5f) * z_f + Real(0.5f));
    }
};

const registered<filterable<unit_depth>> entry{
    method_facts{.id = "msm4_float_unit", .family = "msm4", .label = "MSM 128 bit, depth in [0, 1]", .order = 50}};

} // namespace

} // namespace gnomon::evaluation
