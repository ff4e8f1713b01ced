// expect: reserved word
#ifndef GNOMON_MOMENTS_WORD_TYPE_H
#define GNOMON_MOMENTS_WORD_TYPE_H
/// Depth.
GNOMON_KERNEL Real lower(Real z)
{
    vec3 x;
    return z;
}
#endif
