// expect: division by a constant
#ifndef GNOMON_MOMENTS_DIVISION_H
#define GNOMON_MOMENTS_DIVISION_H
/// Depth.
GNOMON_KERNEL Real lower(Real z) { return z / Real(4) + z / Real(0.5) + z / Real(6); }
#endif
