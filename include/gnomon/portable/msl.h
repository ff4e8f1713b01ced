// Metal: C++14 with address spaces. Kernels are not templates, as in the other shader languages: Real is float.
// Compile with -fno-fast-math and -ffp-contract=off for the same bits as on the CPU.
#ifndef GNOMON_PORTABLE_MSL_H
#define GNOMON_PORTABLE_MSL_H

#if defined(__FAST_MATH__)
#error "gnomon: fast mathematics voids the treatment of NaN: compile with -fno-fast-math, or mathMode = .safe"
#endif

#include "no_templates.h"

#include <metal_stdlib>

#if __METAL_VERSION__ >= 320 // to the end of the file
#pragma METAL fp math_mode(safe)
#endif

#define Real float
#define GNOMON_NAMESPACE_BEGIN namespace gnomon {
#define GNOMON_NAMESPACE_END }
#define GNOMON_KERNEL inline
#define GNOMON_STRUCT(name) struct name
#define GNOMON_CONSTANT(name, value) constant constexpr float name = float(value)
#define GNOMON_FUSED true

namespace gnomon {

constant constexpr float gnomon_pivot_floor = 9.31322574615478515625e-10f; // 2^-30

inline Real gnomon_select(bool mask, Real a, Real b) { return mask ? a : b; }
inline bool gnomon_any(bool mask) { return mask; }
inline Real gnomon_abs(Real a) { return metal::fabs(a); }
inline Real gnomon_sqrt(Real a) { return metal::precise::sqrt(a); }
// x. No compiler rewrites floating-point operations across a minimum of integers, and this one changes no value: only
// bits of NaN are above the bound, which is one.
inline Real gnomon_kept(Real x) { return as_type<Real>(metal::min(as_type<int>(x), 0x7FC00000)); }
inline Real gnomon_apart(Real x) { return as_type<Real>(metal::min(as_type<uint>(x), 0xFFC00000u)); }
#include "kept.h"
inline Real gnomon_fma(Real a, Real b, Real c) { return gnomon_kept(metal::fma(a, b, c)); }
// By integers, so that a NaN becomes 0 where a compiler assumes that there is none.
inline Real gnomon_saturate(Real x)
{
    int bits = as_type<int>(x);
    return gnomon_select(bits > 0x7F800000, Real(0), as_type<Real>(metal::min(metal::max(bits, 0), 0x3F800000)));
}
// a without the low half of its significand.
inline Real gnomon_high_part(Real a) { return as_type<Real>(as_type<uint>(a) & 0xFFFFF000u); }
// The sum has n in its low bits, and the shift moves n into the exponent. int(NaN) would be undefined.
inline Real gnomon_power_of_two(Real n) { return as_type<Real>((as_type<uint>(n + 12582912.0f) << 23) + 0x3F800000u); }

} // namespace gnomon
#endif
