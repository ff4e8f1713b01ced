// Shadow of a receiver that the least and the greatest depth of its search region decide (passes/depth_pyramid.hpp).
//
// All filter regions of a soft shadow lie in its search region. Where no depth of the search region is before the receiver
// after its least bias, none of a filter region is: the receiver is lit. Where all depths are before the receiver after its
// greatest bias, all of a filter region are: the receiver is in the umbra. Both equal exact percentage-closer soft shadows.
// Moments alone cannot say so: a mean blocker depth does not tell whether there is a blocker (Peters et al. 2017, Sec. 4.5).
//
// A bias that grows with the filter is least for a filter of one texel. A tilted plane then has depths before its own
// receivers in every wider search region, so that only receivers that face the light are found lit. A bias that is the
// same for all filters has no such limit.
#ifndef GNOMON_SOFT_DEPTH_INTERVAL_H
#define GNOMON_SOFT_DEPTH_INTERVAL_H
#include "../numerics/select.h"
GNOMON_NAMESPACE_BEGIN

/// The shadow intensity, 0 or 1, where decided is 1. Where decided is 0 the depths leave the intensity open, and it is 0.
GNOMON_STRUCT(decided_shadow) { Real intensity, decided; };

/// The shadow of a receiver at z_f from the least and the greatest depth of its search region. A filter moves the receiver
/// towards the light by least_bias to most_bias. Both members are 0 or 1.
/// Domain: any z_f, limited to [-1, 1]; least <= greatest, else open; negative biases count for nothing.
/// NaN: open.
/// Source: Peters 2017, Sec. 4.5
GNOMON_KERNEL GNOMON_T(decided_shadow) depth_interval_shadow(Real least, Real greatest, Real z_f, Real least_bias,
                                                             Real most_bias)
{
    Real z = clamp_or_nan(z_f, Real(-1), Real(1));
    GNOMON_MASK known = least <= greatest && least_bias <= most_bias;
    GNOMON_MASK umbra = known && (greatest < z - gnomon_max(Real(0), most_bias));
    GNOMON_MASK lit = known && (z - gnomon_max(Real(0), least_bias) <= least);
    GNOMON_T(decided_shadow) r;
    r.intensity = gnomon_select(umbra, Real(1), Real(0));
    r.decided = gnomon_select(umbra || lit, Real(1), Real(0));
    return r;
}

GNOMON_NAMESPACE_END
#endif
