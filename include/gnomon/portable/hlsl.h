// HLSL without templates, for old front ends too.
// Compile with strict IEEE arithmetic (/Gis) for the same bits as on the CPU. Exact products are exact in any case.
#ifndef GNOMON_PORTABLE_HLSL_H
#define GNOMON_PORTABLE_HLSL_H

#define GNOMON_CONSTANT(name, value) static const Real name = Real(value)
#include "glsl_like.h"
#include "precise.h"

Real gnomon_power_of_two(Real n) { return asfloat((int(n) + 127) << 23); }

#endif
