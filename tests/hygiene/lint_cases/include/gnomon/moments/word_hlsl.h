// expect: reserved word
#ifndef GNOMON_MOMENTS_WORD_HLSL_H
#define GNOMON_MOMENTS_WORD_HLSL_H
/// Depth.
GNOMON_KERNEL Real lower(Real z)
{
    Real linear = z;
    return z;
}
#endif
