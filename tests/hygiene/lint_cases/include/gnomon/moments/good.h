// expect: nothing
#ifndef GNOMON_MOMENTS_GOOD_H
#define GNOMON_MOMENTS_GOOD_H
#include "../numerics/two_product.h"
#include "hankel4.h"
/* A comment may say filter, half, float* p, a ? b : c, #pragma once, fma(a, b, c),
   x__y and [](auto& x) over two lines. */
#if defined(GNOMON_LANES) && !defined(GNOMON_SCALAR)
#define GNOMON_WIDTH 4
#endif
GNOMON_NAMESPACE_BEGIN
GNOMON_CONSTANT(scale, 1.5e-3); // sample, near, Real z = 0
/// lower, say.
GNOMON_KERNEL GNOMON_T(double_word) two_product(Real a, Real b)
{
    GNOMON_T(double_word) r;
    if (GNOMON_FUSED) {
        r.low = gnomon_fma(a, b, -r.high);
    }
    return r;
}
/// Depth.
GNOMON_KERNEL Real lower(Real z, GNOMON_SETTING bias)
{
    GNOMON_MASK inside = z > Real(0) && !(z >= bias);
    uint word = code & 1023u;
    for (int i = 0; i < 4; i = i + 1) {
        z = a[i] * z - GNOMON_LITERAL(scale) *
            bias;
    }
    return gnomon_select(inside, z, -z);
}
GNOMON_NAMESPACE_END
#endif
