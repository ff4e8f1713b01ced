// GLSL from version 400, ESSL from version 310.
// Compile without contraction for the same bits as on the CPU (docs/shaders.md). Exact products are exact in any case.
#ifndef GNOMON_PORTABLE_GLSL_H
#define GNOMON_PORTABLE_GLSL_H

#if defined(GL_ES) && __VERSION__ < 310
#error "gnomon: #version 310 es or later needed"
#elif !defined(GL_ES) && __VERSION__ < 400
#error "gnomon: #version 400 or later needed"
#endif

#if defined(GL_ES)
// Kernels need high precision. Declare a lower one after this line if your own code uses it.
precision highp float;
precision highp int;
#endif

#define GNOMON_CONSTANT(name, value) const Real name = Real(value)
#include "glsl_like.h"

#if defined(GL_ES) && __VERSION__ < 320
// This version has no precise. Mesa rewrites nothing across a choice, though, and both sides of this one are equal.
Real gnomon_kept(Real x) { return gnomon_select(abs(x) <= Real(3.4028234663852886e38), x, x + x); }
Real gnomon_min(Real a, Real b) { return gnomon_select(a < b, a, gnomon_kept(b)); }
Real gnomon_max(Real a, Real b) { return gnomon_select(b < a, a, gnomon_kept(b)); }
Real gnomon_product(Real a, Real b) { return gnomon_kept(a * b); }
Real gnomon_difference(Real a, Real b) { return gnomon_kept(a - b); }
#else
#include "precise.h"
#endif
Real gnomon_power_of_two(Real n) { return intBitsToFloat((int(n) + 127) << 23); }

#endif
