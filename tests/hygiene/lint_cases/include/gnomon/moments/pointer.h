// expect: pointer
#ifndef GNOMON_MOMENTS_POINTER_H
#define GNOMON_MOMENTS_POINTER_H
/// Depth.
GNOMON_KERNEL Real lower(Real* z, Real w) { return w; }
#endif
