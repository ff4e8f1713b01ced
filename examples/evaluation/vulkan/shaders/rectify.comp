// Texels of the rectified map from single texels of the shadow map.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "method.glsl"
#include "rectified_view.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform frame { rectified_view seen; };
#include "rectified_map.h"
layout(binding = 1) readonly buffer all_rows { rectified_row rows[]; };
layout(binding = 2) uniform texture2D depths;
layout(binding = 3) writeonly uniform image2D first_map;
layout(binding = 4) writeonly uniform image2D second_map;

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (p.y >= rows.length()) return;
    rectified_row row = rows[p.y];
    float radius = radius_of(p.x), depth = 1;
    vec2 place = place_of(row, radius);
    if (within_map(place)) depth = depth_from_unit(texelFetch(depths, ivec2(place), 0).x);
    texel t = encode(occluder_depth(row, radius, depth, 1));
    imageStore(first_map, p, t.first);
#if GNOMON_METHOD_IMAGES == 2
    imageStore(second_map, p, t.second);
#endif
}
