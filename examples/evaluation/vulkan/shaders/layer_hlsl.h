// What shaders of layers have in GLSL and not in HLSL.
#define barrier GroupMemoryBarrierWithGroupSync
#define atomicOr InterlockedOr
#define atomicMin InterlockedMin
#define const static const
#include "layer_sizes.h"
#undef const
