// The one place that knows which language this is: picks the prelude that gives the kernel dialect its words.
//
// A kernel (every .h beside this file) is one text for C++, CUDA, GLSL, HLSL, Metal and OpenCL. What differs
// between them is spelled by the prelude, and only by it:
//
//   GNOMON_KERNEL                    head of a function: a template over Real in C++
//   GNOMON_DETAIL_KERNEL             the same for a part of other kernels: no user calls it, no table of kernels has a line
//                                    for it, and packages of languages without namespaces give its name a prefix
//   GNOMON_STRUCT(name)              head of a struct, a template over Real in C++
//   GNOMON_T(name)                   that struct for this Real; not needed where a variable is initialised, whose
//                                    type C++ deduces: double_word p = two_product(a, b);
//   GNOMON_LIST_KERNEL, GNOMON_DETAIL_LIST_KERNEL, GNOMON_LIST_STRUCT(name), GNOMON_LIST_T(name)
//                                    the same for a list of at most GNOMON_CAPACITY, of which it holds an array; the
//                                    capacity is a template parameter after Real in C++, a macro elsewhere
//   GNOMON_MASK                      what a comparison of two Reals gives: bool, or one bool per lane
//   GNOMON_SETTING                   a Real parameter that takes no part in deduction, so that packs accept scalars
//   GNOMON_CONSTANT(name, value)     a named number; GNOMON_LITERAL(name) is that number as a Real, rounded once
//   gnomon_select, gnomon_any        choice by mask, and whether any lane of a mask is set
//   gnomon_min, gnomon_max           a < b ? a : b and a > b ? a : b, in this order: the second where one is NaN
//   gnomon_abs, gnomon_sqrt          exact and correctly rounded
//   gnomon_product                   the rounded product, never contracted into a later sum
//   gnomon_difference                a - b rounded, never cancelled against a later sum, as (a - b) - a = -b
//   GNOMON_FUSED, gnomon_fma         whether gnomon_fma(a, b, c) rounds a b + c once; only two_product asks
//   gnomon_power_of_two              2^n for a whole number n within the normal range; any value where n is NaN
//   GNOMON_DIGITS                    p, the bits of the significand: 24 or 53; only numerics/ asks
//   GNOMON_SPLITTER                  2^ceil(p / 2) + 1 for a significand of p bits (Dekker 1971)
//   GNOMON_PIVOT_FLOOR               the least pivot, far above the square of what rounding makes of P_k at a node,
//                                    its 7th power normal once scaled by 2^112: 2^-30, in double 2^-66
//
// Zeros have signs, and not everybody keeps them: for +0, -x is +0 by xsimd's AVX-512, and 0 - x is -0 by Mesa's
// llvmpipe. Where such a zero could reach a result, a kernel has Real(-1) * x, which is -0 everywhere. Mesa also makes
// -0 of the 0 in gnomon_select(mask, Real(-1), Real(0)), and 0 of Real(0) * x, whatever x is.
#ifndef GNOMON_PORTABLE_H
#define GNOMON_PORTABLE_H

#if defined(GNOMON_PACKAGE)
#error "gnomon: a shader package is included already; packages and headers exclude one another"
#elif defined(__METAL_VERSION__)
#include "portable/msl.h"
#elif defined(__OPENCL_C_VERSION__) || defined(__OPENCL_CPP_VERSION__)
#include "portable/opencl.h"
#elif defined(GNOMON_HLSL) || defined(__HLSL_VERSION) || defined(__hlsl_dx_compiler) || defined(__SLANG__)
#include "portable/hlsl.h"
#elif defined(__cplusplus)
#include "portable/cpp.h"
#elif defined(GL_core_profile) || defined(GL_compatibility_profile) || defined(GL_ES) || defined(VULKAN)
#if __VERSION__ == 500 // glslang, reading HLSL
#include "portable/hlsl.h"
#else
#include "portable/glsl.h"
#endif
#else
#error "gnomon: unknown language; an HLSL compiler that defines no macro of its own needs GNOMON_HLSL"
#endif

#define GNOMON_DETAIL_KERNEL GNOMON_KERNEL
#define GNOMON_DETAIL_LIST_KERNEL GNOMON_LIST_KERNEL

#endif
