// Words and functions of GLSL and HLSL. GNOMON_CONSTANT is defined before.
#ifndef GNOMON_PORTABLE_GLSL_LIKE_H
#define GNOMON_PORTABLE_GLSL_LIKE_H

#include "no_templates.h"

#define Real float
#define GNOMON_NAMESPACE_BEGIN
#define GNOMON_NAMESPACE_END
#define GNOMON_KERNEL
#define GNOMON_STRUCT(name) struct name
#define GNOMON_FUSED false

GNOMON_CONSTANT(gnomon_pivot_floor, 9.31322574615478515625e-10); // 2^-30

Real gnomon_select(bool mask, Real a, Real b) { return mask ? a : b; }
bool gnomon_any(bool mask) { return mask; }
Real gnomon_abs(Real a) { return abs(a); }
Real gnomon_sqrt(Real a) { return sqrt(a); }
Real gnomon_fma(Real a, Real b, Real c) { return a * b + c; } // never called: GNOMON_FUSED is false

#endif
