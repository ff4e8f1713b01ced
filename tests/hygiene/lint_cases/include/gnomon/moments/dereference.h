// expect: pointer
#ifndef GNOMON_MOMENTS_DEREFERENCE_H
#define GNOMON_MOMENTS_DEREFERENCE_H
/// Depth.
GNOMON_KERNEL Real lower(Real z) { return z + *z; }
#endif
