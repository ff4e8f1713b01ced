// expect: scope operator
#ifndef GNOMON_MOMENTS_SCOPE_OPERATOR_H
#define GNOMON_MOMENTS_SCOPE_OPERATOR_H
/// Depth.
GNOMON_KERNEL Real lower(Real z)
{
    z = gnomon::square(z);
    return z;
}
#endif
