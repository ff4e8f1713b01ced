// Metal: C++14 with address spaces. Kernels are not templates, as in the other shader languages: Real is float.
// Compile with -fno-fast-math and -ffp-contract=off for the same bits as on the CPU.
#ifndef GNOMON_PORTABLE_MSL_H
#define GNOMON_PORTABLE_MSL_H

#include "no_templates.h"

#include <metal_stdlib>

#define Real float
#define GNOMON_NAMESPACE_BEGIN namespace gnomon {
#define GNOMON_NAMESPACE_END }
#define GNOMON_KERNEL inline
#define GNOMON_STRUCT(name) struct name
#define GNOMON_CONSTANT(name, value) constant constexpr float name = float(value)
#define GNOMON_FUSED true

namespace gnomon {

constant constexpr float gnomon_splitter = 4097.0f;
constant constexpr float gnomon_pivot_floor = 9.31322574615478515625e-10f; // 2^-30

inline Real gnomon_select(bool mask, Real a, Real b) { return mask ? a : b; }
inline bool gnomon_any(bool mask) { return mask; }
inline Real gnomon_min(Real a, Real b) { return a < b ? a : b; }
inline Real gnomon_max(Real a, Real b) { return b < a ? a : b; }
inline Real gnomon_abs(Real a) { return metal::fabs(a); }
inline Real gnomon_sqrt(Real a) { return metal::precise::sqrt(a); }
inline Real gnomon_fma(Real a, Real b, Real c) { return metal::fma(a, b, c); }
inline Real gnomon_product(Real a, Real b) { return metal::fma(a, b, -0.0f); }
inline Real gnomon_difference(Real a, Real b) { return a - b; }
inline Real gnomon_power_of_two(Real n) { return as_type<Real>((int(n) + 127) << 23); }

} // namespace gnomon
#endif
