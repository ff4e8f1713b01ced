// expect: reserved word
#ifndef GNOMON_MOMENTS_WORD_CUDA_H
#define GNOMON_MOMENTS_WORD_CUDA_H
/// Depth.
GNOMON_KERNEL Real lower(Real z)
{
    Real warpSize = z;
    return z;
}
#endif
