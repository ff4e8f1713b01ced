// expect: reserved word
#ifndef GNOMON_MOMENTS_WORD_GLSL_H
#define GNOMON_MOMENTS_WORD_GLSL_H
/// Depth.
GNOMON_KERNEL Real lower(Real z)
{
    Real sample = z;
    return z;
}
#endif
