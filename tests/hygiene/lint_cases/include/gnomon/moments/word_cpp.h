// expect: reserved word
#ifndef GNOMON_MOMENTS_WORD_CPP_H
#define GNOMON_MOMENTS_WORD_CPP_H
/// Depth.
GNOMON_KERNEL Real lower(Real z)
{
    Real bitand = z;
    return z;
}
#endif
