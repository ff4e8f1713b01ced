// rectify.comp in HLSL.
#include "method.hlsl"
#define vec2 float2
#include "rectified_view.h"

[[vk::binding(0)]] cbuffer frame { rectified_view seen; };
#include "rectified_map.h"
[[vk::binding(1)]] StructuredBuffer<rectified_row> rows;
[[vk::binding(2)]] Texture2D<float> depths;
[[vk::binding(3)]] RWTexture2D<float4> first_map;
[[vk::binding(4)]] RWTexture2D<float4> second_map;

[numthreads(8, 8, 1)]
void main(uint3 id : SV_DispatchThreadID)
{
    uint width, height;
    first_map.GetDimensions(width, height);
    if (id.y >= height) return;
    rectified_row row = rows[id.y];
    float radius = radius_of(int(id.x)), depth = 1;
    float2 place = place_of(row, radius);
    if (within_map(place)) depth = depth_from_unit(depths.Load(int3(place, 0)));
    texel t = encode(occluder_depth(row, radius, depth, 1));
    first_map[id.xy] = t.first;
#if GNOMON_METHOD_IMAGES == 2
    second_map[id.xy] = t.second;
#endif
}
