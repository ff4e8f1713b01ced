// expect: double underscore
#ifndef GNOMON_MOMENTS_DOUBLE_UNDERSCORE_H
#define GNOMON_MOMENTS_DOUBLE_UNDERSCORE_H
/// Depth.
GNOMON_KERNEL Real lower(Real z)
{
    Real z__f = z;
    return z;
}
#endif
