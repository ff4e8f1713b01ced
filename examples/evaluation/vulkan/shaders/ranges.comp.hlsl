// ranges.comp in HLSL.
#include "edge_widening.hlsl"
#include "range.hlsl"
#define const static const
#include "tile_record.h"
#undef const

[[vk::binding(0)]] StructuredBuffer<tile_record> records;
[[vk::binding(1)]] StructuredBuffer<uint> blocks;
[[vk::binding(2)]] StructuredBuffer<uint> members;
[[vk::binding(3)]] RWStructuredBuffer<uint> first;
[[vk::binding(4)]] RWStructuredBuffer<depth_time_range> ranges;
[[vk::push_constant]] cbuffer push
{
    uint texels;
    uint fills;
    float tolerance;
};
#include "ranges_of_texel.h"

[numthreads(64, 1, 1)]
void main(uint3 id : SV_DispatchThreadID)
{
    uint i = id.x;
    if (i >= texels) return;
    uint at = add_texel(fills == 1 ? first[i] : 0, i, blocks[i / 16], blocks[i / 16 + 1]);
    if (fills == 0) first[i] = at;
}
