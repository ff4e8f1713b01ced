// soft_lighting.frag in HLSL.
#include "gnomon.hlsl"
#define vec2 float2
#define vec4 float4
#define uvec4 uint4
#include "view.h"

[[vk::binding(0)]] cbuffer frame { view seen; };
[[vk::binding(1)]] Texture2D<uint4> table;
uint4 table_texel(int x, int y) { return table.Load(int3(x, y, 0)); }
#include "soft_shadow.h"

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
    float3 normal = f.normal * (dot(seen.eye.xyz - f.position, f.normal) < 0 ? -1.0 : 1.0);
    float cosine = dot(seen.to_light.xyz, normal);
    float visibility = 1;
    if (cosine > 0 && all(abs(float3(2 * place.xy - 1, place.z)) <= 1)) {
        float steepness = min(1, seen.bias.y * cosine / length(seen.to_light.xyz - cosine * normal));
        depth_gradient gradient;
        gradient.x = steepness * dot(seen.slope_u.xyz, normal) / cosine;
        gradient.y = steepness * dot(seen.slope_v.xyz, normal) / cosine;
        soft_settings settings;
        settings.per_depth = seen.penumbra.xy;
        settings.widest = seen.penumbra.z;
        settings.most_texels = seen.table.x;
        settings.scale = seen.table.y;
        settings.darkening = seen.table.z;
        settings.size = seen.bias.z;
        visibility = 1 - soft_intensity(seen.bias.z * place.xy, place.z, gradient, settings);
    }
    float3 ambient = lerp(seen.earth.rgb, seen.sky.rgb, 0.5 + 0.5 * normal.y);
    return float4(f.albedo * (ambient + visibility * max(cosine, 0) * seen.sun.rgb), visibility);
}
