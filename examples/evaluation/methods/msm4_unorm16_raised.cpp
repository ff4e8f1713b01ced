// Raised pivots instead of the certified bound: they leak less and darken lit surfaces (docs/decisions/2-bias.md).
#include "filterable.hpp"
#include "raised_pivots4.hpp"

namespace gnomon::evaluation {

namespace {

struct raised_pivots : moments4_unorm16 {
    template <class Real> static Real filtered_intensity(const channels4<Real>& channels, Real z_f)
    {
        return hamburger4_lower(bench::hankel4_raised_from(moments4_unorm16{}, channels), z_f);
    }
};

const registered<filterable<raised_pivots>> entry{
    method_facts{.id = "msm4_unorm16_raised", .family = "msm4", .label = "MSM 64 bit, raised pivots", .order = 30}};

} // namespace

} // namespace gnomon::evaluation
