// Shades a pixel by a sun that the map shadows, and by a sky.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "depth_bias.glsl"
#include "moments4.glsl"

layout(binding = 0) uniform frame
{
    vec4 shadow_rows[3]; // from positions to texture coordinates and signed depth
    vec4 to_light;       // direction; w: the depth bias at a slope of 1 and mip level 0
    vec4 sun, sky, earth;
};
layout(binding = 1) uniform texture2D map;
layout(binding = 2) uniform sampler trilinear;
layout(location = 0) in vec3 position;
layout(location = 1) flat in vec3 normal;
layout(location = 2) flat in vec3 albedo;
layout(location = 0) out vec4 colour;

void main()
{
    vec4 p = vec4(position, 1);
    vec2 uv = vec2(dot(shadow_rows[0], p), dot(shadow_rows[1], p));
    float depth = dot(shadow_rows[2], p);
    float footprint = max(1, textureSize(sampler2D(map, trilinear), 0).x * max(length(dFdx(uv)), length(dFdy(uv))));
    float cosine = dot(to_light.xyz, normal);
    float intensity = 0;
    if (cosine > 0 && all(lessThanEqual(abs(vec3(2 * uv - 1, depth)), vec3(1)))) {
        float across = length(to_light.xyz - cosine * normal);
        float bias = depth_bias_slope_scaled(across, cosine, to_light.w * footprint, 5.67);
        vec4 t = textureLod(sampler2D(map, trilinear), uv, log2(footprint));
        intensity = moments4_unorm16_filtered_intensity(channels4(t.x, t.y, t.z, t.w), depth - bias); // the shadow
    }
    vec3 ambient = mix(earth.rgb, sky.rgb, 0.5 + 0.5 * normal.y);
    colour = vec4(albedo * (ambient + (1 - intensity) * max(cosine, 0) * sun.rgb), 1);
}
