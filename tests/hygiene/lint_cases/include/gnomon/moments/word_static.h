// expect: reserved word
#ifndef GNOMON_MOMENTS_WORD_STATIC_H
#define GNOMON_MOMENTS_WORD_STATIC_H
/// Depth.
GNOMON_KERNEL Real lower(Real z)
{
    static x;
    return z;
}
#endif
