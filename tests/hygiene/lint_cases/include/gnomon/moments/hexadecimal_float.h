// expect: hexadecimal float
#ifndef GNOMON_MOMENTS_HEXADECIMAL_FLOAT_H
#define GNOMON_MOMENTS_HEXADECIMAL_FLOAT_H
/// Depth.
GNOMON_KERNEL Real lower(Real z)
{
    z = z * Real(0x1.8p-3);
    return z;
}
#endif
