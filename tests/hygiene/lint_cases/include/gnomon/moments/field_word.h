// expect: field
#ifndef GNOMON_MOMENTS_FIELD_WORD_H
#define GNOMON_MOMENTS_FIELD_WORD_H
/// Lower bound.
/// Errors: 2 ulp.
GNOMON_KERNEL Real lower(Real z) { return z; }
#endif
