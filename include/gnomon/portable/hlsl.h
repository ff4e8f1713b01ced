// HLSL without templates, for old front ends too.
// Compile with strict IEEE arithmetic (/Gis) for the same bits as on the CPU. Exact products are exact in any case.
#ifndef GNOMON_PORTABLE_HLSL_H
#define GNOMON_PORTABLE_HLSL_H

#define GNOMON_CONSTANT(name, value) static const Real name = Real(value)
#include "glsl_like.h"

// x. No compiler rewrites floating-point operations across a minimum of integers, and this one changes no value: only
// bits of NaN are above the bound, which is one.
Real gnomon_kept(Real x) { return asfloat(min(asint(x), 0x7FC00000)); }
Real gnomon_apart(Real x) { return asfloat(min(asuint(x), 0xFFC00000u)); }
#include "kept.h"
// By integers, so that a NaN becomes 0 where a compiler assumes that there is none.
Real gnomon_saturate(Real x)
{
    int bits = asint(x);
    return gnomon_select(bits > 0x7F800000, Real(0), asfloat(min(max(bits, 0), 0x3F800000)));
}
// a without the low half of its significand.
Real gnomon_high_part(Real a) { return asfloat(asuint(a) & 0xFFFFF000u); }
// The sum has n in its low bits, and the shift moves n into the exponent. int(NaN) would be undefined.
Real gnomon_power_of_two(Real n) { return asfloat((asuint(n + Real(12582912)) << 23u) + 0x3F800000u); }

#endif
