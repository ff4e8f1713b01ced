// expect: conditional operator
#ifndef GNOMON_MOMENTS_CONDITIONAL_OPERATOR_H
#define GNOMON_MOMENTS_CONDITIONAL_OPERATOR_H
/// Depth.
GNOMON_KERNEL Real lower(Real z)
{
    z = z < Real(0) ? -z : z;
    return z;
}
#endif
