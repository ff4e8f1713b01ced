// HLSL without templates, for old front ends too.
// Compile with strict IEEE arithmetic (/Gis) for the same bits as on the CPU. Exact products are exact in any case.
#ifndef GNOMON_PORTABLE_HLSL_H
#define GNOMON_PORTABLE_HLSL_H

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
#define GNOMON_CONSTANT(name, value) static const Real name = Real(value)
#define GNOMON_LITERAL(name) name
#define GNOMON_FUSED false
#define GNOMON_DIGITS 24
#define GNOMON_SPLITTER gnomon_splitter
#define GNOMON_PIVOT_FLOOR gnomon_pivot_floor

static const Real gnomon_splitter = Real(4097);
static const Real gnomon_pivot_floor = Real(9.31322574615478515625e-10); // 2^-30

Real gnomon_select(bool mask, Real a, Real b) { return mask ? a : b; }
bool gnomon_any(bool mask) { return mask; }
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
Real gnomon_abs(Real a) { return abs(a); }
Real gnomon_sqrt(Real a) { return sqrt(a); }
Real gnomon_fma(Real a, Real b, Real c) { return a * b + c; } // never called: GNOMON_FUSED is false
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
Real gnomon_power_of_two(Real n) { return asfloat((int(n) + 127) << 23); }

#endif
