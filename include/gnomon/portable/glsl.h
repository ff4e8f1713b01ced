// GLSL from version 400, ESSL from version 310.
// Compile without contraction for the same bits as on the CPU (docs/shaders.md). Exact products are exact in any case.
#ifndef GNOMON_PORTABLE_GLSL_H
#define GNOMON_PORTABLE_GLSL_H

#if defined(GL_ES) && __VERSION__ < 310
#error "gnomon: #version 310 es or later needed"
#elif !defined(GL_ES) && __VERSION__ < 400
#error "gnomon: #version 400 or later needed"
#endif

#define Real float
#define GNOMON_NAMESPACE_BEGIN
#define GNOMON_NAMESPACE_END
#define GNOMON_KERNEL
#define GNOMON_STRUCT(name) struct name
#define GNOMON_T(name) name
#define GNOMON_LIST_KERNEL
#define GNOMON_LIST_STRUCT(name) struct name
#define GNOMON_LIST_T(name) name
#define GNOMON_CAPACITY GNOMON_RANGE_CAPACITY
#define GNOMON_MASK bool
#define GNOMON_SETTING Real
#define GNOMON_CONSTANT(name, value) const Real name = Real(value)
#define GNOMON_LITERAL(name) name
#define GNOMON_FUSED false
#define GNOMON_DIGITS 24
#define GNOMON_SPLITTER gnomon_splitter
#define GNOMON_PIVOT_FLOOR gnomon_pivot_floor

#if defined(GL_ES)
// Kernels need high precision. Declare a lower one after this line if your own code uses it.
precision highp float;
precision highp int;
#endif

const Real gnomon_splitter = Real(4097);
const Real gnomon_pivot_floor = Real(9.31322574615478515625e-10); // 2^-30

Real gnomon_select(bool mask, Real a, Real b) { return mask ? a : b; }
bool gnomon_any(bool mask) { return mask; }
Real gnomon_abs(Real a) { return abs(a); }
Real gnomon_sqrt(Real a) { return sqrt(a); }
Real gnomon_fma(Real a, Real b, Real c) { return a * b + c; } // never called: GNOMON_FUSED is false
// Without precise, or gnomon_kept, Mesa fuses and cancels operations and uses min() and max(), which lose a NaN.
#if defined(GL_ES) && __VERSION__ < 320
// This version has no precise. Mesa rewrites nothing across a choice, though, and both sides of this one are equal.
Real gnomon_kept(Real x) { return gnomon_select(abs(x) <= Real(3.4028234663852886e38), x, x + x); }
Real gnomon_min(Real a, Real b) { return gnomon_select(a < b, a, gnomon_kept(b)); }
Real gnomon_max(Real a, Real b) { return gnomon_select(b < a, a, gnomon_kept(b)); }
Real gnomon_product(Real a, Real b) { return gnomon_kept(a * b); }
Real gnomon_difference(Real a, Real b) { return gnomon_kept(a - b); }
#else
Real gnomon_min(Real a, Real b)
{
    precise Real m = a < b ? a : b;
    return m;
}
Real gnomon_max(Real a, Real b)
{
    precise Real m = b < a ? a : b;
    return m;
}
Real gnomon_product(Real a, Real b)
{
    precise Real p = a * b;
    return p;
}
Real gnomon_difference(Real a, Real b)
{
    precise Real d = a - b;
    return d;
}
#endif
Real gnomon_power_of_two(Real n) { return intBitsToFloat((int(n) + 127) << 23); }

#endif
