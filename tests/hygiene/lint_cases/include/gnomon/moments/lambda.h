// expect: lambda
#ifndef GNOMON_MOMENTS_LAMBDA_H
#define GNOMON_MOMENTS_LAMBDA_H
/// Depth.
GNOMON_KERNEL Real lower(Real z)
{
    z = [](Real x) { return x; }(z);
    return z;
}
#endif
