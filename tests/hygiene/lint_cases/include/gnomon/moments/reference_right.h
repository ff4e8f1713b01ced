// expect: reference
#ifndef GNOMON_MOMENTS_REFERENCE_RIGHT_H
#define GNOMON_MOMENTS_REFERENCE_RIGHT_H
/// Depth.
GNOMON_KERNEL Real lower(Real &z) { return z; }
#endif
