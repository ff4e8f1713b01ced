// expect: no comment
#ifndef GNOMON_MOMENTS_NO_COMMENT_H
#define GNOMON_MOMENTS_NO_COMMENT_H
GNOMON_KERNEL Real lower(Real z) { return z; }
#endif
