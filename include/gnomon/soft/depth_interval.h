// Shadow of a receiver that the least and the greatest depth of its search region decide (passes/depth_pyramid.hpp).
//
// All filter regions of a soft shadow lie in its search region. Where no depth of the search region is before the
// receiver, none of a filter region is: the receiver is lit. Where all depths are before the receiver after its bias,
// all of a filter region are: the receiver is in the umbra. Both equal exact percentage-closer soft shadows. Moments
// alone cannot say so: a mean blocker depth does not tell whether there is a blocker (Peters et al. 2017, Sec. 4.5).
#ifndef GNOMON_SOFT_DEPTH_INTERVAL_H
#define GNOMON_SOFT_DEPTH_INTERVAL_H
#include "../numerics/select.h"
GNOMON_NAMESPACE_BEGIN

/// The shadow intensity, 0 or 1, where decided is 1. Where decided is 0 the depths leave the intensity open, and it is 0.
GNOMON_STRUCT(decided_shadow) { Real intensity, decided; };

/// The shadow of a receiver at z_f from the least and the greatest depth of its search region. bias is the most that a
/// filter moves the receiver towards the light. Both members are 0 or 1.
/// Domain: any z_f, limited to [-1, 1]; least <= greatest, else open; a negative bias counts for nothing.
/// NaN: open.
/// Source: Peters 2017, Sec. 4.5
GNOMON_KERNEL GNOMON_T(decided_shadow) depth_interval_shadow(Real least, Real greatest, Real z_f, Real bias)
{
    Real z = clamp_or_nan(z_f, Real(-1), Real(1));
    GNOMON_MASK ordered = least <= greatest;
    GNOMON_MASK umbra = ordered && (bias <= bias) && (greatest < z - gnomon_max(Real(0), bias));
    GNOMON_MASK lit = ordered && (z <= least);
    GNOMON_T(decided_shadow) r;
    r.intensity = gnomon_select(umbra, Real(1), Real(0));
    r.decided = gnomon_select(umbra || lit, Real(1), Real(0));
    return r;
}

GNOMON_NAMESPACE_END
#endif
