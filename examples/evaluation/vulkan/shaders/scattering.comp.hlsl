// scattering.comp in HLSL.
#include "method.hlsl"
#define vec2 float2
#include "rectified_view.h"

[[vk::binding(0)]] cbuffer frame { rectified_view seen; };
#include "rectified_map.h"
[[vk::binding(1)]] StructuredBuffer<rectified_row> rows;
[[vk::binding(2)]] Texture2D<float4> first_map;
[[vk::binding(3)]] Texture2D<float4> second_map;
[[vk::binding(4)]] SamplerState of_rows;
[[vk::binding(5)]] Texture2D<float> camera_depth;
[[vk::binding(6)]] Texture2D<float4> surfaces;
[[vk::binding(7)]] RWTexture2D<float4> picture;

texel averages_at(rectified_position ray, float row, float optical_depth, int level)
{
    float columns = max(seen.texel.z / float(1 << level), 1);
    float u = sampled_column(rectified_column_of(ray.radius, seen.texel.x), columns, optical_depth);
    texel t;
    t.first = first_map.SampleLevel(of_rows, float2(u, row / seen.texel.w), level);
    t.second = second_map.SampleLevel(of_rows, float2(u, row / seen.texel.w), level);
    return t;
}

float intensity_of(rectified_position ray, float cosine, float footprint)
{
    float row = rectified_row_of(ray.azimuth, seen.frame.y, seen.frame.z, seen.texel.w);
    row_pair between = row_pair_of(row);
    float lower = ray_depth(rows[between.lower], ray.polar), upper = ray_depth(rows[between.upper], ray.polar);
    float depth = lerp(lower, upper, between.fraction);
    float optical_depth = rows[between.lower].optical_depth;
    uint width, height, levels;
    first_map.GetDimensions(0, width, height, levels);
    float level = min(level_of(ray.radius, footprint), levels - 1);
    texel fine = averages_at(ray, row, optical_depth, int(level));
    texel coarse = averages_at(ray, row, optical_depth, int(ceil(level)));
    texel both;
    both.first = lerp(fine.first, coarse.first, frac(level));
    both.second = lerp(fine.second, coarse.second, frac(level));
    return bounds_intensity(GNOMON_SCATTERING_BOUNDS(channels_of(both), depth), adaptive_overestimation(cosine));
}

[numthreads(8, 8, 1)]
void main(uint3 id : SV_DispatchThreadID)
{
    uint width, height;
    picture.GetDimensions(width, height);
    if (id.x >= width || id.y >= height) return;
    float ahead = view_distance(camera_depth.Load(int3(id.xy, 0)));
    float2 uv = (float2(id.xy) + 0.5) / float2(width, height);
    float3 end = ahead * (seen.corner + uv.x * seen.right + uv.y * seen.down).xyz;
    float cosine = rectified_cosine(end.x, end.y, end.z);
    float intensity = intensity_of(rectified_from_position(end.x, end.y, end.z), cosine, ahead * seen.planes.z);
    float phase = phase_henyey_greenstein(-cosine, seen.planes.w);
    float3 surface = surfaces.Load(int3(id.xy, 0)).rgb, radiance;
    for (int i = 0; i < 3; ++i)
        radiance[i] = scattering_radiance(surface[i], intensity, length(end), seen.extinction[i], seen.scattering[i],
                                          phase, seen.irradiance[i]);
    picture[id.xy] = float4(radiance, 1 - intensity);
}
