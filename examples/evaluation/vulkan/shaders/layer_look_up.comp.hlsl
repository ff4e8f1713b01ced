// layer_look_up.comp in HLSL.
#include "layer_look_up.hlsl"
#include "layer_sums.hlsl"
#include "layer_hlsl.h"

[[vk::push_constant]] cbuffer push { layer_push given; };
[[vk::binding(0)]] StructuredBuffer<uint> first;
[[vk::binding(1)]] StructuredBuffer<layer_grid> grids;
[[vk::binding(2)]] StructuredBuffer<layer_sums> layer_texels;
[[vk::binding(3)]] StructuredBuffer<uint> blocks;
[[vk::binding(4)]] StructuredBuffer<layer_sums> plain;
#define const static const
#include "layer_look_up.h"
#undef const
[[vk::binding(5)]] StructuredBuffer<layer_receiver> receivers;
[[vk::binding(6)]] RWStructuredBuffer<float> intensities;

[numthreads(64, 1, 1)]
void main(uint3 id : SV_DispatchThreadID)
{
    if (id.x < given.receivers) intensities[id.x] = layer_intensity(receivers[id.x]);
}
