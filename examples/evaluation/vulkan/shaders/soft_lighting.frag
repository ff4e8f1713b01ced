// The camera's picture: a sun of an angular size, its shadows from a summed-area table, and a sky. Alpha is the sun's
// visibility.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "gnomon.glsl"
#include "view.h"

layout(binding = 0) uniform frame { view seen; };
layout(binding = 1) uniform utexture2D table;
uvec4 table_texel(int x, int y) { return texelFetch(table, ivec2(x, y), 0); }
#include "soft_shadow.h"

layout(location = 0) in vec3 position;
layout(location = 1) flat in vec3 triangle_normal;
layout(location = 2) flat in vec3 albedo;
layout(location = 0) out vec4 colour;

void main()
{
    vec4 p = vec4(position, 1);
    vec3 place = vec3(dot(seen.light_rows[0], p), dot(seen.light_rows[1], p), dot(seen.light_rows[2], p));
    vec3 normal = triangle_normal * (dot(seen.eye.xyz - position, triangle_normal) < 0 ? -1.0 : 1.0);
    float cosine = dot(seen.to_light.xyz, normal);
    float visibility = 1;
    if (cosine > 0 && all(lessThanEqual(abs(vec3(2 * place.xy - 1, place.z)), vec3(1)))) {
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
    vec3 ambient = mix(seen.earth.rgb, seen.sky.rgb, 0.5 + 0.5 * normal.y);
    colour = vec4(albedo * (ambient + visibility * max(cosine, 0) * seen.sun.rgb), visibility);
}
