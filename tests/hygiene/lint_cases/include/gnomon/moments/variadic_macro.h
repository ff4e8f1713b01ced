// expect: ellipsis
#ifndef GNOMON_MOMENTS_VARIADIC_MACRO_H
#define GNOMON_MOMENTS_VARIADIC_MACRO_H
#define GNOMON_ALL(...) 0
#endif
