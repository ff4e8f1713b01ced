// expect: reserved word
#ifndef GNOMON_MOMENTS_WORD_AUTO_H
#define GNOMON_MOMENTS_WORD_AUTO_H
GNOMON_KERNEL Real lower(Real z)
{
    auto x;
    return z;
}
#endif
