// layer_plain.comp in HLSL.
#include "layer_sums.hlsl"
#include "layer_hlsl.h"

[[vk::binding(0)]] StructuredBuffer<stochastic_sample> all_samples;
[[vk::binding(1)]] StructuredBuffer<uint> blocks;
[[vk::binding(2)]] RWStructuredBuffer<layer_sums> plain;
[[vk::push_constant]] cbuffer push { layer_push given; };
#include "layer_no_sums.h"
#include "layer_plain.h"

[numthreads(8, 8, 1)]
void main(uint3 id : SV_DispatchThreadID) { fill_plain(id.x, id.y); }
