#include "gnomon.hlsl"
#define vec4 float4
[[vk::constant_id(0)]] const int method = 0;
[[vk::constant_id(1)]] const int images = 1;
[[vk::constant_id(2)]] const float setting0 = 0;
[[vk::constant_id(3)]] const float setting1 = 0;
[[vk::constant_id(4)]] const float setting2 = 0;
#include "method.h"
