// expect: nothing
#ifndef GNOMON_MOMENTS_SOURCE_GOOD_H
#define GNOMON_MOMENTS_SOURCE_GOOD_H
/// Lower bound.
/// Domain: z in [-1, 1].
/// NaN: lit.
/// Error: 2 ulp,
///     error, float: max 1e-6
/// Source: Peters 2017, Eq. 3; Hong & Oh 2018, Sec. 4.1; Peters 2017, App. A;
/// Dekker 1971
GNOMON_KERNEL Real lower(Real z) { return z; }
#endif
