// OpenCL C from version 1.2, full profile. Put #pragma OPENCL FP_CONTRACT OFF before the kernels, and build without
// relaxed mathematics, for the same bits as on the CPU.
#ifndef GNOMON_PORTABLE_OPENCL_H
#define GNOMON_PORTABLE_OPENCL_H

#if defined(__OPENCL_C_VERSION__) && __OPENCL_C_VERSION__ < 120
#error "gnomon: -cl-std=CL1.2 or later needed"
#elif defined(__EMBEDDED_PROFILE__)
#error "gnomon: the full profile needed: the embedded one rounds as it likes"
#elif defined(__FAST_RELAXED_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "gnomon: -cl-fast-relaxed-math and -cl-finite-math-only void the treatment of NaN; build without them"
#endif

#include "no_templates.h"

// OpenCL C has no conversion Real(x). A macro with the name of the type supplies it, and is not expanded where
// no parenthesis follows.
typedef float Real;
#define Real(x) ((float)(x))
#define GNOMON_NAMESPACE_BEGIN
#define GNOMON_NAMESPACE_END
#define GNOMON_KERNEL static inline
// clang-format off
#define GNOMON_STRUCT(name) typedef struct name name; struct name
// clang-format on
#define GNOMON_CONSTANT(name, value) __constant float name = (float)(value)
#define GNOMON_FUSED true

__constant float gnomon_pivot_floor = 9.31322574615478515625e-10f; // 2^-30

static inline Real gnomon_select(bool mask, Real a, Real b) { return mask ? a : b; }
static inline bool gnomon_any(bool mask) { return mask; }
static inline Real gnomon_abs(Real a) { return fabs(a); }
static inline Real gnomon_sqrt(Real a) { return sqrt(a); }
// x. No compiler rewrites floating-point operations across a minimum of integers, and this one changes no value: only
// bits of NaN are above the bound, which is one.
static inline Real gnomon_kept(Real x) { return as_float(min(as_int(x), 0x7FC00000)); }
static inline Real gnomon_apart(Real x) { return as_float(min(as_uint(x), 0xFFC00000u)); }
#include "kept.h"
static inline Real gnomon_fma(Real a, Real b, Real c) { return gnomon_kept(fma(a, b, c)); }
// By integers, so that a NaN becomes 0 where a compiler assumes that there is none.
static inline Real gnomon_saturate(Real x)
{
    int bits = as_int(x);
    return gnomon_select(bits > 0x7F800000, Real(0), as_float(min(max(bits, 0), 0x3F800000)));
}
// a without the low half of its significand.
static inline Real gnomon_high_part(Real a) { return as_float(as_uint(a) & 0xFFFFF000u); }
// The sum has n in its low bits, and the shift moves n into the exponent. int(NaN) would be undefined.
static inline Real gnomon_power_of_two(Real n) { return as_float((as_uint(n + 12582912.0f) << 23) + 0x3F800000u); }

#endif
