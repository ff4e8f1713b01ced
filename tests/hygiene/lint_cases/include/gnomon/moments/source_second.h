// expect: source
#ifndef GNOMON_MOMENTS_SOURCE_SECOND_H
#define GNOMON_MOMENTS_SOURCE_SECOND_H
/// Lower bound.
/// Source: Peters 2017, Eq. 3;
/// Peters, Sec. 2
GNOMON_KERNEL Real lower(Real z) { return z; }
#endif
