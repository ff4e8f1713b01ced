// Words of the languages in which Real is float and a kernel is no template: GLSL, HLSL, Metal and OpenCL C.
#ifndef GNOMON_PORTABLE_NO_TEMPLATES_H
#define GNOMON_PORTABLE_NO_TEMPLATES_H

#define GNOMON_T(name) name
#define GNOMON_LIST_KERNEL GNOMON_KERNEL
#define GNOMON_LIST_STRUCT(name) GNOMON_STRUCT(name)
#define GNOMON_LIST_T(name) name
#define GNOMON_CAPACITY GNOMON_RANGE_CAPACITY
#define GNOMON_MASK bool
#define GNOMON_SETTING Real
#define GNOMON_LITERAL(name) name
#define GNOMON_DIGITS 24
#define GNOMON_PIVOT_FLOOR gnomon_pivot_floor

#endif
