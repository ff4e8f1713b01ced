// resolve.comp in HLSL.
#include "method.hlsl"

[[vk::binding(0)]] Texture2DMS<float, 4> depths;
[[vk::binding(1)]] RWTexture2D<float4> first_map;
[[vk::binding(2)]] RWTexture2D<float4> second_map;

[numthreads(8, 8, 1)]
void main(uint3 id : SV_DispatchThreadID)
{
    texel mean = {float4(0, 0, 0, 0), float4(0, 0, 0, 0)};
    for (int i = 0; i < 4; ++i) {
        texel t = encode(depth_from_unit(depths.Load(int2(id.xy), i)));
        mean.first += 0.25 * t.first;
        mean.second += 0.25 * t.second;
    }
    first_map[id.xy] = mean.first;
#if GNOMON_METHOD_IMAGES == 2
    second_map[id.xy] = mean.second;
#endif
}
