// expect: division by a constant
#ifndef GNOMON_MOMENTS_DIVISION_LITERAL_H
#define GNOMON_MOMENTS_DIVISION_LITERAL_H
GNOMON_CONSTANT(third, 0.3);
/// Depth.
GNOMON_KERNEL Real lower(Real z) { return z / GNOMON_LITERAL(third); }
#endif
