// expect: nothing
#ifndef GNOMON_MOMENTS_USED_HELPER_H
#define GNOMON_MOMENTS_USED_HELPER_H
GNOMON_DETAIL_KERNEL GNOMON_MASK helper_below(Real z) { return z < Real(0); }
/// Lower bound.
GNOMON_KERNEL Real lower(Real z) { return gnomon_select(helper_below(z), z, z); }
#endif
