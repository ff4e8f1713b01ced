// The camera's picture: a sun, shadowed by the map, and a sky (renderer/shade/shading.cpp). Alpha is the sun's visibility.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "view.h"

layout(binding = 0) uniform frame { view seen; };
#include "method.glsl"

layout(binding = 1) uniform texture2D first_map;
layout(binding = 2) uniform texture2D second_map;
layout(binding = 3) uniform sampler trilinear;
layout(location = 0) in vec3 position;
layout(location = 1) flat in vec3 triangle_normal;
layout(location = 2) flat in vec3 albedo;
layout(location = 0) out vec4 colour;

void main()
{
    vec4 p = vec4(position, 1);
    vec3 place = vec3(dot(seen.light_rows[0], p), dot(seen.light_rows[1], p), dot(seen.light_rows[2], p));
    vec2 uv = place.xy;
    float texels = seen.bias.z * max(length(dFdx(uv)), length(dFdy(uv)));
    vec3 normal = triangle_normal * (dot(seen.eye.xyz - position, triangle_normal) < 0 ? -1.0 : 1.0);
    float cosine = dot(seen.to_light.xyz, normal);
    float visibility = 1;
    if (cosine > 0 && all(lessThanEqual(abs(vec3(2 * uv - 1, place.z)), vec3(1)))) {
        float footprint = max(texels, 1);
        float slope = min(length(seen.to_light.xyz - cosine * normal) / cosine, seen.bias.y);
        float level = log2(footprint);
        texel filtered;
        filtered.first = textureLod(sampler2D(first_map, trilinear), uv, level);
        filtered.second = textureLod(sampler2D(second_map, trilinear), uv, level);
        visibility = 1 - intensity(filtered, place.z - seen.bias.x * footprint * slope);
    }
    vec3 ambient = mix(seen.earth.rgb, seen.sky.rgb, 0.5 + 0.5 * normal.y);
    colour = vec4(albedo * (ambient + visibility * max(cosine, 0) * seen.sun.rgb), visibility);
}
