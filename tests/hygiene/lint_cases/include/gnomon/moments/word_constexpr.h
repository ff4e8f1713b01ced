// expect: reserved word
#ifndef GNOMON_MOMENTS_WORD_CONSTEXPR_H
#define GNOMON_MOMENTS_WORD_CONSTEXPR_H
/// Depth.
GNOMON_KERNEL Real lower(Real z)
{
    constexpr x;
    return z;
}
#endif
