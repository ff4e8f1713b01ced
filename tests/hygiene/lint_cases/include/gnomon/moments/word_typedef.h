// expect: reserved word
#ifndef GNOMON_MOMENTS_WORD_TYPEDEF_H
#define GNOMON_MOMENTS_WORD_TYPEDEF_H
/// Depth.
GNOMON_KERNEL Real lower(Real z)
{
    typedef x;
    return z;
}
#endif
