// expect: scope operator
#ifndef GNOMON_MOMENTS_SCOPE_OPERATOR_H
#define GNOMON_MOMENTS_SCOPE_OPERATOR_H
GNOMON_KERNEL Real lower(Real z)
{
    z = gnomon::square(z);
    return z;
}
#endif
