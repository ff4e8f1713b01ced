// Depth to moments: the values of a moment shadow map before any storage format.
// b_j = E[z^j] over the depths in a filter region, j = 1..4 or 1..6; b_0 = 1 is not stored (Peters et al.
// 2017, 2.1, 2.2.1). Filtering, blending and resolving are linear combinations of such vectors with weights that sum
// to 1.
#ifndef GNOMON_MOMENTS_MOMENTS_H
#define GNOMON_MOMENTS_MOMENTS_H
#include "../portable.h"
#include "depth.h"
GNOMON_NAMESPACE_BEGIN

GNOMON_STRUCT(moments4) { Real b1, b2, b3, b4; };

GNOMON_STRUCT(moments6) { Real b1, b2, b3, b4, b5, b6; };

/// The four moments of a single depth z.
/// Domain: z in [-1, 1].
/// NaN: NaN.
/// Source: Peters 2017, App. D.1
GNOMON_KERNEL GNOMON_T(moments4) moments4_from_depth(Real z)
{
    GNOMON_T(moments4) b;
    b.b1 = z;
    b.b2 = z * z;
    b.b3 = b.b2 * z;
    b.b4 = b.b2 * b.b2;
    return b;
}

/// The six moments of a single depth z.
/// Domain: z in [-1, 1].
/// NaN: NaN.
GNOMON_KERNEL GNOMON_T(moments6) moments6_from_depth(Real z)
{
    GNOMON_T(moments6) b;
    b.b1 = z;
    b.b2 = z * z;
    b.b3 = b.b2 * z;
    b.b4 = b.b2 * b.b2;
    b.b5 = b.b4 * z;
    b.b6 = b.b3 * b.b3;
    return b;
}

/// b times weight: the first term of a linear combination.
GNOMON_KERNEL GNOMON_T(moments4) moments4_scale(GNOMON_T(moments4) b, GNOMON_SETTING weight)
{
    b.b1 = b.b1 * weight;
    b.b2 = b.b2 * weight;
    b.b3 = b.b3 * weight;
    b.b4 = b.b4 * weight;
    return b;
}

/// sum + weight b: a further term of a linear combination.
GNOMON_KERNEL GNOMON_T(moments4) moments4_add(GNOMON_T(moments4) sum, GNOMON_T(moments4) b, GNOMON_SETTING weight)
{
    sum.b1 = sum.b1 + b.b1 * weight;
    sum.b2 = sum.b2 + b.b2 * weight;
    sum.b3 = sum.b3 + b.b3 * weight;
    sum.b4 = sum.b4 + b.b4 * weight;
    return sum;
}

/// b times weight: the first term of a linear combination.
GNOMON_KERNEL GNOMON_T(moments6) moments6_scale(GNOMON_T(moments6) b, GNOMON_SETTING weight)
{
    b.b1 = b.b1 * weight;
    b.b2 = b.b2 * weight;
    b.b3 = b.b3 * weight;
    b.b4 = b.b4 * weight;
    b.b5 = b.b5 * weight;
    b.b6 = b.b6 * weight;
    return b;
}

/// sum + weight b: a further term of a linear combination.
GNOMON_KERNEL GNOMON_T(moments6) moments6_add(GNOMON_T(moments6) sum, GNOMON_T(moments6) b, GNOMON_SETTING weight)
{
    sum.b1 = sum.b1 + b.b1 * weight;
    sum.b2 = sum.b2 + b.b2 * weight;
    sum.b3 = sum.b3 + b.b3 * weight;
    sum.b4 = sum.b4 + b.b4 * weight;
    sum.b5 = sum.b5 + b.b5 * weight;
    sum.b6 = sum.b6 + b.b6 * weight;
    return sum;
}

/// The moments of signed depth from moments c of depth in [0, 1], as older maps store them: Equation 2 with x = 2, y = -1.
/// Source: Peters 2017, Eq. 2
GNOMON_KERNEL GNOMON_T(moments4) moments4_from_unit(GNOMON_T(moments4) c)
{
    GNOMON_T(moments4) b;
    b.b1 = Real(2) * c.b1 - Real(1);
    b.b2 = Real(4) * (c.b2 - c.b1) + Real(1);
    b.b3 = (Real(8) * c.b3 - Real(12) * c.b2) + (Real(6) * c.b1 - Real(1));
    b.b4 = Real(16) * (c.b4 - Real(2) * c.b3) + (Real(24) * c.b2 - Real(8) * c.b1 + Real(1));
    return b;
}

GNOMON_NAMESPACE_END
#endif
