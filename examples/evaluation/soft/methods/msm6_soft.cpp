// Moment soft shadow mapping of six moments, interpolated, with the umbra skip.
#include "evaluation/soft/look_up.hpp"

#include <gnomon/storage/moments6_summed.hpp>

namespace gnomon::evaluation {

namespace {

struct moments6_kernels {
    using table = moments6_summed;

    template <class Real> static hankel6<Real> region(const channels6<Real>& c, Real most_texels)
    {
        return hankel6_from_summed(c, most_texels);
    }
    template <class Real> static Real blocker(const hankel6<Real>& h, Real z_f) { return blocker6_depth(h, z_f); }
    template <class Real> static Real occlusion(const hankel6<Real>& h, Real z_f) { return hamburger6_lower(h, z_f); }
    template <class Real> static Real shadow(const channels6<Real>& c, Real most_texels, Real z_f)
    {
        return table::intensity(c, most_texels, z_f);
    }
};

const registered<summed_method<moments6_kernels, look_up_options{}>> entry{
    method_facts{.id = "msm6_soft", .family = "msm6", .label = "MSM soft, 6 moments", .order = 200}};

} // namespace

} // namespace gnomon::evaluation
