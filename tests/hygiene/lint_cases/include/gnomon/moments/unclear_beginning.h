// expect: unclear beginning
#ifndef GNOMON_MOMENTS_UNCLEAR_BEGINNING_H
#define GNOMON_MOMENTS_UNCLEAR_BEGINNING_H
/// The same for filtered texels.
GNOMON_KERNEL Real lower(Real z) { return z; }
#endif
