// GLSL from version 330, ESSL from version 300.
// Compile without contraction for the same bits as on the CPU (docs/shaders.md). Exact products are exact in any case.
#ifndef GNOMON_PORTABLE_GLSL_H
#define GNOMON_PORTABLE_GLSL_H

#if defined(GL_ES) && __VERSION__ < 300
#error "gnomon: #version 300 es or later needed"
#elif !defined(GL_ES) && __VERSION__ < 330
#error "gnomon: #version 330 or later needed"
#endif

#if defined(GL_ES)
// Kernels need high precision. Declare a lower one after this line if your own code uses it.
precision highp float;
precision highp int;
#endif

#define GNOMON_CONSTANT(name, value) const Real name = Real(value)
#include "glsl_like.h"

// x. No compiler rewrites floating-point operations across a minimum of integers, and this one changes no value: only
// bits of NaN are above the bound, which is one.
Real gnomon_kept(Real x) { return intBitsToFloat(min(floatBitsToInt(x), 0x7FC00000)); }
Real gnomon_apart(Real x) { return uintBitsToFloat(min(floatBitsToUint(x), 0xFFC00000u)); }
#include "kept.h"
// By integers, so that a NaN becomes 0 where a compiler assumes that there is none.
Real gnomon_saturate(Real x)
{
    int bits = floatBitsToInt(x);
    return gnomon_select(bits > 0x7F800000, Real(0), intBitsToFloat(min(max(bits, 0), 0x3F800000)));
}
// a without the low half of its significand.
Real gnomon_high_part(Real a) { return uintBitsToFloat(floatBitsToUint(a) & 0xFFFFF000u); }
// The sum has n in its low bits, and the shift moves n into the exponent. int(NaN) would be undefined.
Real gnomon_power_of_two(Real n) { return uintBitsToFloat((floatBitsToUint(n + Real(12582912)) << 23u) + 0x3F800000u); }

#endif
