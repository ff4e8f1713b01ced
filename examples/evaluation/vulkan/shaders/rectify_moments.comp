// Texels of the rectified map from a map of four moments in 16-bit UNORM: the distribution of two depths that a filter over
// the texel's footprint has, each depth mapped (Peters et al. 2017, Alg. 2).
#version 450
#extension GL_GOOGLE_include_directive : require
#include "method.glsl"
#include "rectified_view.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform frame { rectified_view seen; };
#include "rectified_map.h"
layout(binding = 1) readonly buffer all_rows { rectified_row rows[]; };
layout(binding = 2) uniform texture2D moments;
layout(binding = 3) uniform sampler trilinear;
layout(binding = 4) writeonly uniform image2D first_map;
layout(binding = 5) writeonly uniform image2D second_map;

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    if (p.y >= rows.length()) return;
    rectified_row row = rows[p.y];
    float radius = radius_of(p.x);
    vec2 place = place_of(row, radius);
    texel t = encode(1);
    if (within_map(place)) {
        vec2 uv = place / seen.eye.w;
        gnomon_distribution2 two = two_depths(textureLod(sampler2D(moments, trilinear), uv, shadow_level(radius)));
        float far_plane = 1 - sqrt(two_point_unorm16_least_variance); // as far as roundings tell
        texel first = encode(occluder_depth(row, radius, two.depth1, far_plane));
        texel second = encode(occluder_depth(row, radius, two.depth2, far_plane));
        t.first = two.weight1 * first.first + two.weight2 * second.first;
        t.second = two.weight1 * first.second + two.weight2 * second.second;
    }
    imageStore(first_map, p, t.first);
#if GNOMON_METHOD_IMAGES == 2
    imageStore(second_map, p, t.second);
#endif
}
