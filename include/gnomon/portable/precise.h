// Functions of GLSL and HLSL that need the word precise, which GLSL has from version 400, ESSL from version 320.
#ifndef GNOMON_PORTABLE_PRECISE_H
#define GNOMON_PORTABLE_PRECISE_H

// Without precise, Mesa fuses and cancels operations and uses min() and max(), which lose a NaN.
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
