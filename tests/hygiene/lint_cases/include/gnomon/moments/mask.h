// expect: mask
#ifndef GNOMON_MOMENTS_MASK_H
#define GNOMON_MOMENTS_MASK_H
/// Lower bound.
GNOMON_KERNEL Real lower(GNOMON_MASK mask, Real z) { return gnomon_select(mask, z, z); }
#endif
