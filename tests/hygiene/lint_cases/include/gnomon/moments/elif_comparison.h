// expect: #if without defined
#ifndef GNOMON_MOMENTS_ELIF_COMPARISON_H
#define GNOMON_MOMENTS_ELIF_COMPARISON_H
#if defined(GNOMON_LANES)
#elif GNOMON_LANES > 4
#endif
#endif
