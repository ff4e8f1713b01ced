// layer.frag in HLSL.
#include "method.hlsl"
#define vec2 float2
#include "puff.h"

struct fragment {
    float4 pixel : SV_Position;
    [[vk::location(0)]] float3 surface : TEXCOORD;
};

struct blended {
    float4 above_first : SV_Target0;
    float4 above_second : SV_Target1;
};

blended main(fragment f)
{
    texel t = encode(depth_from_unit(f.pixel.z));
    float alpha = f.surface.z * puff(f.surface.xy);
    blended result;
    result.above_first = float4(t.first.xy, 0, alpha);
    result.above_second = float4(t.second.xy, 0, alpha);
    return result;
}
