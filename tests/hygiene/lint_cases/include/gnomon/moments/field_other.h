// expect: field
#ifndef GNOMON_MOMENTS_FIELD_OTHER_H
#define GNOMON_MOMENTS_FIELD_OTHER_H
/// Lower bound.
/// Returns: z.
GNOMON_KERNEL Real lower(Real z) { return z; }
#endif
