// expect: unused helper
#ifndef GNOMON_MOMENTS_UNUSED_HELPER_H
#define GNOMON_MOMENTS_UNUSED_HELPER_H
GNOMON_DETAIL_KERNEL Real nobody_calls_this(Real z) { return z; }
#endif
