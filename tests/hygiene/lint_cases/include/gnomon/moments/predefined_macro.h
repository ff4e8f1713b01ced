// expect: double underscore
#ifndef GNOMON_MOMENTS_PREDEFINED_MACRO_H
#define GNOMON_MOMENTS_PREDEFINED_MACRO_H
#if defined(__SSE2__)
#endif
#endif
