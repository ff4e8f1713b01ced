// The kernel dialect: this file detects the language and includes the prelude that spells the words of the dialect.
//
// A kernel (every .h beside this file) is one text for C++, CUDA, GLSL, HLSL, Metal and OpenCL. Only the preludes
// differ between these languages. The words:
//
//   GNOMON_KERNEL                    head of a function: a template over Real in C++
//   GNOMON_DETAIL_KERNEL             head of a function that is a part of other kernels and that no user calls; it has no
//                                    line in the table of kernels, and packages of languages without namespaces give
//                                    its name a prefix
//   GNOMON_STRUCT(name)              head of a struct: a template over Real in C++
//   GNOMON_T(name)                   that struct for this Real; not needed for a variable that is initialised, since C++
//                                    deduces its type: double_word p = two_product(a, b);
//   GNOMON_LIST_KERNEL, GNOMON_DETAIL_LIST_KERNEL, GNOMON_LIST_STRUCT(name), GNOMON_LIST_T(name)
//                                    the same words for structs that hold an array of GNOMON_CAPACITY elements; the
//                                    capacity is a template parameter after Real in C++, a macro elsewhere
//   GNOMON_MASK                      type of a comparison of two Reals: bool, or one bool per lane
//   GNOMON_SETTING                   a Real parameter that does not take part in deduction, so that a call with packs
//                                    accepts scalars for it
//   GNOMON_CONSTANT(name, value)     definition of a named number
//   GNOMON_LITERAL(name)             that number as a Real, rounded once
//   gnomon_select                    choice by a mask
//   gnomon_any                       true if any lane of a mask is set
//   gnomon_min, gnomon_max           a < b ? a : b and a > b ? a : b in this order: the second operand if one is NaN
//   gnomon_saturate                  x clamped to [0, 1]; 0 if it is NaN
//   gnomon_abs, gnomon_sqrt          exact and correctly rounded
//   gnomon_product                   the rounded product, never contracted into a later sum
//   gnomon_sum, gnomon_difference    the rounded sum and difference, never fused, cancelled against a later sum, as
//                                    (a - b) - a = -b, or summed in another order
//   GNOMON_FUSED                     true if gnomon_fma is one instruction that rounds once; used only by two_product
//   gnomon_fma                       a b + c; used only by two_product
//   gnomon_power_of_two              2^n for a whole number n in the range of normal exponents; any value for NaN
//   GNOMON_DIGITS                    the number p of bits of the significand, 24 or 53; used only in numerics/
//   gnomon_high_part                 a rounded to so few bits that products of two such parts, and of what they leave of
//                                    a, are exact; in which direction is not said
//   GNOMON_PIVOT_FLOOR               the least pivot of a factored matrix: 2^-30, or 2^-66 in double; far above the
//                                    square of the rounding error of P_k at a node, and so large that its 7th power
//                                    times 2^112 is a normal number
//
// Kernels compare by < <= > >= and ==, not by !=: of NaN, that of xsimd 8.1 says false.
//
// Not every implementation keeps the sign of a zero. For +0, -x is +0 in AVX-512 code of xsimd, and 0 - x is -0 in
// Mesa's llvmpipe. Where such a zero could reach a result, kernels use Real(-1) * x, which is -0 everywhere. Mesa also
// returns -0 for the 0 in gnomon_select(mask, Real(-1), Real(0)), and 0 for Real(0) * x with any x.
#ifndef GNOMON_PORTABLE_H
#define GNOMON_PORTABLE_H
#include "version.h"

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
