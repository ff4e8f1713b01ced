// Four moments in a summed-area table (moments4_summed.h), where the sharp bound for depths in [-1, 1] (hausdorff4.h) takes
// the place of that for any depths. Intensities exceed Z(z < z_f) by at most moments4_summed_within_weight.
#ifndef GNOMON_STORAGE_MOMENTS4_SUMMED_WITHIN_H
#define GNOMON_STORAGE_MOMENTS4_SUMMED_WITHIN_H
#include "../moments/hausdorff4.h"
#include "moments4_summed.h"
GNOMON_NAMESPACE_BEGIN

GNOMON_CONSTANT(moments4_summed_within_bias_ratio, 6.2); // 1 / r
GNOMON_CONSTANT(moments4_summed_within_float_weight, 1e-6);

/// The weight of the bias of hankel4_from_summed_within: what the errors of the channels make necessary, and what float
/// arithmetic rounds in the bound.
/// Domain: most_texels at least 0.
GNOMON_KERNEL Real moments4_summed_within_weight(Real most_texels)
{
    return GNOMON_LITERAL(moments4_summed_within_bias_ratio) * summed_area_noise(most_texels) +
           GNOMON_LITERAL(moments4_summed_within_float_weight);
}

/// The factored matrix of the channels of a rectangle, with a bias for depths in [-1, 1].
GNOMON_KERNEL GNOMON_T(hankel4) hankel4_from_summed_within(GNOMON_T(channels4) c, GNOMON_SETTING most_texels)
{
    return hankel4_from_summed_theta(c, GNOMON_LITERAL(bias4_theta_within_b2), GNOMON_LITERAL(bias4_theta_within_b4),
                                     gnomon_min(moments4_summed_within_weight(most_texels), Real(0.5)));
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a rectangle.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: 0, lit.
GNOMON_KERNEL Real moments4_summed_intensity_within(GNOMON_T(channels4) c, GNOMON_SETTING most_texels, Real z_f)
{
    return hausdorff4_lower(hankel4_from_summed_within(c, most_texels), z_f);
}

GNOMON_NAMESPACE_END
#endif
