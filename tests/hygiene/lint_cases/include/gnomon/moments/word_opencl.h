// expect: reserved word
#ifndef GNOMON_MOMENTS_WORD_OPENCL_H
#define GNOMON_MOMENTS_WORD_OPENCL_H
/// Depth.
GNOMON_KERNEL Real lower(Real z)
{
    Real global = z;
    return z;
}
#endif
