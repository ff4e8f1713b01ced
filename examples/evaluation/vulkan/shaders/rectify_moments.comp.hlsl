// rectify_moments.comp in HLSL.
#include "method.hlsl"
#define vec2 float2
#include "rectified_view.h"

[[vk::binding(0)]] cbuffer frame { rectified_view seen; };
#include "rectified_map.h"
[[vk::binding(1)]] StructuredBuffer<rectified_row> rows;
[[vk::binding(2)]] Texture2D<float4> moments;
[[vk::binding(3)]] SamplerState trilinear;
[[vk::binding(4)]] RWTexture2D<float4> first_map;
[[vk::binding(5)]] RWTexture2D<float4> second_map;

[numthreads(8, 8, 1)]
void main(uint3 id : SV_DispatchThreadID)
{
    uint width, height;
    first_map.GetDimensions(width, height);
    if (id.y >= height) return;
    rectified_row row = rows[id.y];
    float radius = radius_of(int(id.x));
    float2 place = place_of(row, radius);
    texel t = encode(1);
    if (within_map(place)) {
        float2 uv = place / seen.eye.w;
        gnomon_distribution2 two = two_depths(moments.SampleLevel(trilinear, uv, shadow_level(radius)));
        float far_plane = 1 - sqrt(two_point_unorm16_least_variance); // as far as roundings tell
        texel first = encode(occluder_depth(row, radius, two.depth1, far_plane));
        texel second = encode(occluder_depth(row, radius, two.depth2, far_plane));
        t.first = two.weight1 * first.first + two.weight2 * second.first;
        t.second = two.weight1 * first.second + two.weight2 * second.second;
    }
    first_map[id.xy] = t.first;
#if GNOMON_METHOD_IMAGES == 2
    second_map[id.xy] = t.second;
#endif
}
