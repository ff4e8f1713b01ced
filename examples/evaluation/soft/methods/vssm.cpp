// Variance soft shadow mapping without its hierarchy and its subdivision of kernels: moment soft shadows of two moments, as
// Peters et al. 2017, Sec. 4.6, compare with.
#include "evaluation/soft/look_up.hpp"

#include <gnomon/storage/variance_summed.hpp>

namespace gnomon::evaluation {

namespace {

struct variance_kernels {
    using table = variance_summed;
    template <class Real> struct searched {
        channels2<Real> means;
        Real most_texels;
    };

    template <class Real> static searched<Real> region(const channels2<Real>& c, Real most_texels)
    {
        return {c, most_texels};
    }
    template <class Real> static Real blocker(const searched<Real>& s, Real z_f)
    {
        return table::blocker(s.means, s.most_texels, z_f);
    }
    template <class Real> static Real occlusion(const searched<Real>& s, Real z_f)
    {
        return table::intensity(s.means, s.most_texels, z_f);
    }
    template <class Real> static Real shadow(const channels2<Real>& c, Real most_texels, Real z_f)
    {
        return table::intensity(c, most_texels, z_f);
    }
};

const registered<summed_method<variance_kernels, look_up_options{}>> entry{
    method_facts{.id = "vssm", .family = "vsm", .label = "VSSM, 2 moments, naive", .order = 200}};

} // namespace

} // namespace gnomon::evaluation
