// Words of GLSL that shaders of layers need and HLSL lacks.
#define barrier GroupMemoryBarrierWithGroupSync
#define atomicOr InterlockedOr
#define atomicMin InterlockedMin
#define const static const
#include "layer_sizes.h"
#undef const
