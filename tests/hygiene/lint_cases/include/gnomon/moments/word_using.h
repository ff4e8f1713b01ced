// expect: reserved word
#ifndef GNOMON_MOMENTS_WORD_USING_H
#define GNOMON_MOMENTS_WORD_USING_H
/// Depth.
GNOMON_KERNEL Real lower(Real z)
{
    using x;
    return z;
}
#endif
