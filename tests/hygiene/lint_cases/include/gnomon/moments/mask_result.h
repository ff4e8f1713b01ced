// expect: mask
#ifndef GNOMON_MOMENTS_MASK_RESULT_H
#define GNOMON_MOMENTS_MASK_RESULT_H
/// True below 0.
GNOMON_KERNEL GNOMON_MASK below(Real z) { return z < Real(0); }
#endif
