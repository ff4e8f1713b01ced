// expect: reserved word
#ifndef GNOMON_MOMENTS_WORD_MSL_H
#define GNOMON_MOMENTS_WORD_MSL_H
/// Depth.
GNOMON_KERNEL Real lower(Real z)
{
    Real device = z;
    return z;
}
#endif
