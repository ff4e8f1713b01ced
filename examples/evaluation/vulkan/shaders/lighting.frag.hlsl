// lighting.frag in HLSL.
#define vec4 float4
#include "view.h"

[[vk::binding(0)]] cbuffer frame { view seen; };
#include "method.hlsl"

[[vk::binding(1)]] Texture2D<float4> first_map;
[[vk::binding(2)]] Texture2D<float4> second_map;
[[vk::binding(3)]] SamplerState trilinear;

struct fragment {
    float4 pixel : SV_Position;
    [[vk::location(0)]] float3 position : POSITION;
    [[vk::location(1)]] nointerpolation float3 normal : NORMAL;
    [[vk::location(2)]] nointerpolation float3 albedo : COLOR;
};

float4 main(fragment f) : SV_Target
{
    float4 p = float4(f.position, 1);
    float3 place = float3(dot(seen.light_rows[0], p), dot(seen.light_rows[1], p), dot(seen.light_rows[2], p));
    float2 uv = place.xy;
    float texels = seen.bias.z * max(length(ddx(uv)), length(ddy(uv)));
    float3 normal = f.normal * (dot(seen.eye.xyz - f.position, f.normal) < 0 ? -1.0 : 1.0);
    float cosine = dot(seen.to_light.xyz, normal);
    float visibility = 1;
    if (cosine > 0 && all(abs(float3(2 * uv - 1, place.z)) <= 1)) {
        float footprint = max(texels, 1);
        float slope = min(length(seen.to_light.xyz - cosine * normal) / cosine, seen.bias.y);
        float level = log2(footprint);
        texel filtered;
        filtered.first = first_map.SampleLevel(trilinear, uv, level);
        filtered.second = second_map.SampleLevel(trilinear, uv, level);
        visibility = 1 - intensity(filtered, place.z - seen.bias.x * footprint * slope);
    }
    float3 ambient = lerp(seen.earth.rgb, seen.sky.rgb, 0.5 + 0.5 * normal.y);
    return float4(f.albedo * (ambient + visibility * max(cosine, 0) * seen.sun.rgb), visibility);
}
