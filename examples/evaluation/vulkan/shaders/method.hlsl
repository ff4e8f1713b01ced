#include "gnomon.hlsl"
#define vec4 float4
#include "method.h"
