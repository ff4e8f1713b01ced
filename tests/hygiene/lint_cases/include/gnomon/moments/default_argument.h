// expect: default argument
#ifndef GNOMON_MOMENTS_DEFAULT_ARGUMENT_H
#define GNOMON_MOMENTS_DEFAULT_ARGUMENT_H
/// Depth.
GNOMON_KERNEL Real lower(Real z, Real bias = Real(0)) { return z + bias; }
#endif
