// Variance shadow maps with translucent occluders (Peters et al. 2017, Figure 5a). The upper bound is Cantelli's, too.
#include "evaluation/translucent/blended.hpp"
#include "rules.hpp"

namespace gnomon::evaluation {

namespace {

struct variance_rule {
    using format = variance_unorm16;
    template <class Real> using channels = format::channels<Real>;

    template <class Real> static Real lower(const channels<Real>& c, Real, Real z_f)
    {
        return variance_unorm16_intensity(c, z_f);
    }
    template <class Real> static hamburger_bounds<Real> bounds(const channels<Real>& c, Real, Real z_f)
    {
        const channels<Real> mirrored{Real(1) - c.c1, c.c2};
        return mirrored_bounds(variance_unorm16_intensity(c, z_f), variance_unorm16_intensity(mirrored, Real(0) - z_f));
    }
};

const registered<blended<variance_rule>> entry{
    method_facts{.id = "vsm_unorm16_blended", .family = "vsm", .label = "VSM 32 bit", .order = 110}};

} // namespace

} // namespace gnomon::evaluation
