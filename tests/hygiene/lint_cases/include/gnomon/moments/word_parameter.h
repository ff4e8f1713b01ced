// expect: reserved word
#ifndef GNOMON_MOMENTS_WORD_PARAMETER_H
#define GNOMON_MOMENTS_WORD_PARAMETER_H
/// Depth.
GNOMON_KERNEL Real lower(Real filter) { return Real(0); }
#endif
