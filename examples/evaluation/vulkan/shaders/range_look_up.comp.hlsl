// range_look_up.comp in HLSL.
#include "moving_receiver.hlsl"

[[vk::binding(0)]] StructuredBuffer<uint> first;
[[vk::binding(1)]] StructuredBuffer<depth_time_range> ranges;
[[vk::binding(2)]] StructuredBuffer<receiver_path> receivers;
[[vk::binding(3)]] RWStructuredBuffer<float> intensities;
[[vk::push_constant]] cbuffer push
{
    uint begin, end; // of the receivers
    uint size;
    uint moves;
};
#include "range_look_up.h"

[numthreads(64, 1, 1)]
void main(uint3 id : SV_DispatchThreadID)
{
    uint i = begin + id.x;
    if (i >= end) return;
    if (moves == 1) intensities[i] = moving_intensity(receivers[i]);
    else intensities[i] = static_intensity(receivers[i]);
}
