// expect: #if without defined
#ifndef GNOMON_MOMENTS_IF_VALUE_H
#define GNOMON_MOMENTS_IF_VALUE_H
#if GNOMON_LANES
#endif
#endif
