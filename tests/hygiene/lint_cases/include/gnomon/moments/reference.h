// expect: reference
#ifndef GNOMON_MOMENTS_REFERENCE_H
#define GNOMON_MOMENTS_REFERENCE_H
/// Depth.
GNOMON_KERNEL Real lower(const Real& z) { return z; }
#endif
