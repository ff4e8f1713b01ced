// expect: inequality
#ifndef GNOMON_MOMENTS_INEQUALITY_H
#define GNOMON_MOMENTS_INEQUALITY_H
/// Depth.
GNOMON_KERNEL Real lower(Real z) { return gnomon_select(z != z, Real(0), z); }
#endif
