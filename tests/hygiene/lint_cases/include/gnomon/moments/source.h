// expect: source
#ifndef GNOMON_MOMENTS_SOURCE_H
#define GNOMON_MOMENTS_SOURCE_H
/// Lower bound.
/// Source: Peters 2017, (3)
GNOMON_KERNEL Real lower(Real z) { return z; }
#endif
