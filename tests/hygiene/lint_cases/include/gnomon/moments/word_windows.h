// expect: reserved word
#ifndef GNOMON_MOMENTS_WORD_WINDOWS_H
#define GNOMON_MOMENTS_WORD_WINDOWS_H
/// Depth.
GNOMON_KERNEL Real lower(Real z)
{
    Real near = z;
    return z;
}
#endif
