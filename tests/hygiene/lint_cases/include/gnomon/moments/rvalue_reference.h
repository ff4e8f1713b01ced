// expect: reference
#ifndef GNOMON_MOMENTS_RVALUE_REFERENCE_H
#define GNOMON_MOMENTS_RVALUE_REFERENCE_H
/// Depth.
GNOMON_KERNEL Real lower(Real&& z) { return z; }
#endif
