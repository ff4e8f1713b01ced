// Moments of depth in another range: a cascade, a cube face or a cached map with planes of its own. Signed depth in one
// range is an affine function of signed depth in another, and so the moments of one follow from those of the other
// (Peters et al. 2017, Eq. 2). Thus moments of two cascades can be mixed, and one reconstruction serves for both.
//
//     change = depth_change_from_planes(near_distance, far_distance, target_near, target_far);
//     b = moments4_affine(b, change);                 moments of depths z are now moments of z scale + offset
//
// Change to a range that contains the other. Then |scale| + |offset| <= 1, depths stay in [-1, 1], and what rounding did to
// moments does not grow: an error of at most e in every moment stays at most e. Towards a narrower range errors grow by
// (|scale| + |offset|)^j, and depths leave [-1, 1]: convert the receiver's depth instead, which costs no precision.
//
// Honest bounds need the error of raw moments, which for 4 x 16 UNORM is larger than that of channels: the constant bias
// of affine4_unorm16_weight covers one rounding of each mixed map.
#ifndef GNOMON_MOMENTS_AFFINE_H
#define GNOMON_MOMENTS_AFFINE_H
#include "moments.h"
GNOMON_NAMESPACE_BEGIN

// (1/3 + sqrt 3) / (2 65535) / r, where r = 0.17678 is the distance of the bias vector (0, 0.375, 0, 0.375) to the boundary
// of the vectors of moments, and the error of theta4_inverse and moments4_affine in float.
GNOMON_CONSTANT(affine4_unorm16_weight, 9.6e-5);

/// The function z scale + offset, from signed depth in one range to signed depth in another.
GNOMON_STRUCT(depth_change) { Real scale, offset; };

/// The change from signed depth between two planes, at near_distance and far_distance from the light, to signed depth
/// between two others, at target_near and target_far. All distances are measured along the same axis, in any unit.
/// Domain: near_distance < far_distance, target_near < target_far.
/// NaN: NaN.
/// Error: 8 2^-p of the largest distance over target_far - target_near.
GNOMON_KERNEL GNOMON_T(depth_change) depth_change_from_planes(Real near_distance, Real far_distance, Real target_near,
                                                              Real target_far)
{
    Real extent = target_far - target_near;
    GNOMON_T(depth_change) r;
    r.scale = (far_distance - near_distance) / extent;
    r.offset = ((near_distance - target_near) + (far_distance - target_far)) / extent;
    return r;
}

/// Signed depth z in the other range.
/// NaN: NaN.
/// Error: two roundings.
GNOMON_KERNEL Real depth_affine(Real z, GNOMON_T(depth_change) change) { return z * change.scale + change.offset; }

/// The moments of z scale + offset, where b are the four moments of z.
/// Domain: |scale| + |offset| <= 1 for the error.
/// NaN: NaN.
/// Error: 6 2^-p, absolute.
/// Source: Peters 2017, Eq. 2
GNOMON_KERNEL GNOMON_T(moments4) moments4_affine(GNOMON_T(moments4) b, GNOMON_T(depth_change) change)
{
    Real s = change.scale;
    Real o = change.offset;
    Real s2 = s * s;
    Real c1 = s * b.b1;
    Real c2 = s2 * b.b2;
    Real c3 = s2 * s * b.b3;
    GNOMON_T(moments4) r;
    r.b1 = c1 + o;
    r.b2 = c2 + o * (Real(2) * c1 + o);
    r.b3 = c3 + o * (Real(3) * c2 + o * (Real(3) * c1 + o));
    r.b4 = s2 * s2 * b.b4 + o * (Real(4) * c3 + o * (Real(6) * c2 + o * (Real(4) * c1 + o)));
    return r;
}

/// The moments of z scale + offset, where b are the six moments of z.
/// Domain: |scale| + |offset| <= 1 for the error.
/// NaN: NaN.
/// Error: 9 2^-p, absolute.
GNOMON_KERNEL GNOMON_T(moments6) moments6_affine(GNOMON_T(moments6) b, GNOMON_T(depth_change) change)
{
    Real s = change.scale;
    Real o = change.offset;
    Real s2 = s * s;
    Real c1 = s * b.b1;
    Real c2 = s2 * b.b2;
    Real c3 = s2 * s * b.b3;
    Real c4 = s2 * s2 * b.b4;
    Real c5 = s2 * s2 * s * b.b5;
    GNOMON_T(moments6) r;
    r.b1 = c1 + o;
    r.b2 = c2 + o * (Real(2) * c1 + o);
    r.b3 = c3 + o * (Real(3) * c2 + o * (Real(3) * c1 + o));
    r.b4 = c4 + o * (Real(4) * c3 + o * (Real(6) * c2 + o * (Real(4) * c1 + o)));
    r.b5 = c5 + o * (Real(5) * c4 + o * (Real(10) * c3 + o * (Real(10) * c2 + o * (Real(5) * c1 + o))));
    r.b6 =
        s2 * s2 * s2 * b.b6 +
        o * (Real(6) * c5 + o * (Real(15) * c4 + o * (Real(20) * c3 + o * (Real(15) * c2 + o * (Real(6) * c1 + o)))));
    return r;
}

GNOMON_NAMESPACE_END
#endif
