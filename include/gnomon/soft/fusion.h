// Soft shadows of two occluders, one behind the other, of which each has a penumbra of its own. A single mean blocker
// depth gives both the same width, so that the contact of the one is as soft as that of the other (Peters et al. 2017,
// Fig. 10).
//
// The canonical distribution of the search region with a node at z_f (hamburger4.h) has two other nodes. Where both are
// before z_f they are the two occluders, first and second:
//     between  the middle of their depths
//     k1, k2   filter regions of the penumbrae of the first and of the second occluder (penumbra.h)
//     I1       intensity of k1 at between: the share of the light that the first occluder blocks
//     c        intensity of k2 at between: the share of k2 that the first occluder covers
//     I2       intensity of k2 at z_f: the share that either covers
// Of the part of k2 that the first occluder leaves, the second covers (I2 - c) / (1 - c). Both block light independently
// of one another, so the visibility is (1 - I1) (1 - (I2 - c) / (1 - c)). It is 1 - I2 where the occluders coincide, and
// where the first one is missing. Where the first covers all of k2, nothing is known of the second, and blocker_epsilon
// makes little of what bounds leave between I2 and c. The receiver is moved by its bias for I2, and between is not deeper
// than the moved receiver, or the receiver's own plane would be taken for an occluder.
//
// Costs beside those of one occluder: one root for the nodes, a second filter region and two more intensities, only where
// fusion_occluders found two.
#ifndef GNOMON_SOFT_FUSION_H
#define GNOMON_SOFT_FUSION_H
#include "blocker.h"
GNOMON_NAMESPACE_BEGIN

/// The depths of two occluders, first <= second, and the depth between that parts them. A between of -1 says that there
/// is one occluder, the second, or none.
GNOMON_STRUCT(occluder_pair) { Real first, second, between; };

/// The depth of an occluder at depth z with a weight, in [-1, z_f].
GNOMON_DETAIL_KERNEL Real fusion_depth(Real z, Real weight, Real z_f)
{
    return blocker_depth_before(z_f, (z_f - z) * (weight / (weight + GNOMON_LITERAL(blocker_epsilon))));
}

/// The two occluders before z_f in a search region, from the canonical distribution d with depth0 = z_f. Like the mean
/// blocker depth of blocker.h, each is near z_f where its weight is not far above blocker_epsilon. One occluder is the
/// second, and first equals second.
/// NaN: no occluder, both at the depth of the receiver.
GNOMON_KERNEL GNOMON_T(occluder_pair) fusion_occluders(GNOMON_T(distribution3) d)
{
    Real z_f = clamp_or_high(d.depth0, Real(-1), Real(1));
    Real z1 = clamp_or_high(d.depth1, Real(-1), z_f);
    Real z2 = clamp_or_high(d.depth2, Real(-1), z_f);
    GNOMON_MASK two = d.depth1 < d.depth2 && d.depth2 < z_f;
    Real first = fusion_depth(z1, saturate_or_zero(d.weight1), z_f);
    Real second = fusion_depth(z2, saturate_or_zero(d.weight2), z_f);
    GNOMON_T(occluder_pair) r;
    r.second = gnomon_select(two, second, first);
    r.first = gnomon_min(first, r.second);
    r.between = gnomon_select(two, Real(0.5) * (z1 + z2), Real(-1));
    return r;
}

/// Shadow intensity in [0, 1] of two occluders: blocked is I1, covered is c and either is I2 of the first comment of this
/// file. With covered 0 and blocked 0 it is either.
/// Domain: each in [0, 1], clamped.
/// NaN: counts as 0, lit.
GNOMON_KERNEL Real fusion_intensity(Real blocked, Real covered, Real either)
{
    Real one = saturate_or_zero(blocked);
    Real c = saturate_or_zero(covered);
    Real left = (Real(1) - c) + GNOMON_LITERAL(blocker_epsilon) * c;
    Real two = saturate_or_zero((saturate_or_zero(either) - c) / left);
    return saturate_or_zero(one + (Real(1) - one) * two);
}

GNOMON_NAMESPACE_END
#endif
