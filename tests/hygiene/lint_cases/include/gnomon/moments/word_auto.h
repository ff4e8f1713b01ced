// expect: reserved word
#ifndef GNOMON_MOMENTS_WORD_AUTO_H
#define GNOMON_MOMENTS_WORD_AUTO_H
/// Depth.
GNOMON_KERNEL Real lower(Real z)
{
    auto x;
    return z;
}
#endif
