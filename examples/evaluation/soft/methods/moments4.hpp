// Moment soft shadow maps of four moments: the blocker search and the intensity of the library, with the bias of the table.
#pragma once

#include "evaluation/soft/look_up.hpp"

#include <gnomon/storage/moments4_summed.hpp>

namespace gnomon::evaluation {

struct moments4_kernels {
    using table = moments4_summed;

    template <class Real> static hankel4<Real> region(const channels4<Real>& c, Real most_texels)
    {
        return hankel4_from_summed(c, most_texels);
    }
    template <class Real> static Real blocker(const hankel4<Real>& h, Real z_f) { return blocker4_depth(h, z_f); }
    template <class Real> static Real occlusion(const hankel4<Real>& h, Real z_f) { return hamburger4_lower(h, z_f); }
    template <class Real> static Real shadow(const channels4<Real>& c, Real most_texels, Real z_f)
    {
        return table::intensity(c, most_texels, z_f);
    }
};

} // namespace gnomon::evaluation
