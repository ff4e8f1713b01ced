// expect: reserved word
#ifndef GNOMON_MOMENTS_WORD_WGSL_H
#define GNOMON_MOMENTS_WORD_WGSL_H
/// Depth.
GNOMON_KERNEL Real lower(Real z)
{
    Real target = z;
    return z;
}
#endif
