// expect: fused multiply-add
#ifndef GNOMON_MOMENTS_FMA_H
#define GNOMON_MOMENTS_FMA_H
/// Depth.
GNOMON_KERNEL Real lower(Real z) { return gnomon_fma(z, z, z); }
#endif
