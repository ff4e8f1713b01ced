// The camera's picture with light that the air scatters once, from the camera's depth: one look-up of a rectified map of prefix
// averages for each pixel. Alpha is the visible share of the scattering.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "method.glsl"
#include "rectified_view.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform frame { rectified_view seen; };
#include "rectified_map.h"
layout(binding = 1) readonly buffer all_rows { rectified_row rows[]; };
layout(binding = 2) uniform texture2D first_map;
layout(binding = 3) uniform texture2D second_map;
layout(binding = 4) uniform sampler of_rows;
layout(binding = 5) uniform texture2D camera_depth;
layout(binding = 6) uniform texture2D surfaces;
layout(binding = 7) writeonly uniform image2D picture;

// Of a whole level: the averages up to the end of a view ray.
texel averages_at(rectified_position ray, float row, float optical_depth, int level)
{
    float columns = max(seen.texel.z / float(1 << level), 1);
    float u = sampled_column(rectified_column_of(ray.radius, seen.texel.x), columns, optical_depth);
    texel t;
    t.first = textureLod(sampler2D(first_map, of_rows), vec2(u, row / seen.texel.w), level);
    t.second = textureLod(sampler2D(second_map, of_rows), vec2(u, row / seen.texel.w), level);
    return t;
}

float intensity_of(rectified_position ray, float cosine, float footprint)
{
    float row = rectified_row_of(ray.azimuth, seen.frame.y, seen.frame.z, seen.texel.w);
    row_pair between = row_pair_of(row);
    float lower = ray_depth(rows[between.lower], ray.polar), upper = ray_depth(rows[between.upper], ray.polar);
    float depth = mix(lower, upper, between.fraction);
    float optical_depth = rows[between.lower].optical_depth;
    float level = min(level_of(ray.radius, footprint), textureQueryLevels(first_map) - 1);
    texel fine = averages_at(ray, row, optical_depth, int(level));
    texel coarse = averages_at(ray, row, optical_depth, int(ceil(level)));
    texel both;
    both.first = mix(fine.first, coarse.first, fract(level));
    both.second = mix(fine.second, coarse.second, fract(level));
    return bounds_intensity(GNOMON_SCATTERING_BOUNDS(channels_of(both), depth), adaptive_overestimation(cosine));
}

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy), size = textureSize(camera_depth, 0);
    if (any(greaterThanEqual(p, size))) return;
    float ahead = view_distance(texelFetch(camera_depth, p, 0).x);
    vec2 uv = (vec2(p) + 0.5) / vec2(size);
    vec3 end = ahead * (seen.corner + uv.x * seen.right + uv.y * seen.down).xyz;
    float cosine = rectified_cosine(end.x, end.y, end.z);
    float intensity = intensity_of(rectified_from_position(end.x, end.y, end.z), cosine, ahead * seen.planes.z);
    float phase = phase_henyey_greenstein(-cosine, seen.planes.w);
    vec3 surface = texelFetch(surfaces, p, 0).rgb, radiance;
    for (int i = 0; i < 3; ++i)
        radiance[i] = scattering_radiance(surface[i], intensity, length(end), seen.extinction[i], seen.scattering[i],
                                          phase, seen.irradiance[i]);
    imageStore(picture, p, vec4(radiance, 1 - intensity));
}
