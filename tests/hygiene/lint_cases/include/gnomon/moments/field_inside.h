// expect: field
#ifndef GNOMON_MOMENTS_FIELD_INSIDE_H
#define GNOMON_MOMENTS_FIELD_INSIDE_H
/// Lower bound. Error: 2 ulp.
GNOMON_KERNEL Real lower(Real z) { return z; }
#endif
