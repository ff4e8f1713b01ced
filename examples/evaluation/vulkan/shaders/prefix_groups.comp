// Prefix averages of the rows of a rectified map, by groups of 8 x 8 invocations (Peters et al. 2017, App. C). A group goes
// from block to block of 8 rows. Each invocation computes all averages of its row, and keeps the one at its place in the
// block. Reads are eight times as many as texels, and caches answer them. Groups of z = 1 take the second image.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "gnomon.glsl"
#include "rectified_row.h"

const int side = 8;
layout(local_size_x = side, local_size_y = side) in;
layout(binding = 0) uniform texture2D first_source;
layout(binding = 1) uniform texture2D second_source;
layout(binding = 2) writeonly uniform image2D first_target;
layout(binding = 3) writeonly uniform image2D second_target;
layout(binding = 4) readonly buffer all_rows { rectified_row rows[]; };

void main()
{
    bool is_first = gl_WorkGroupID.z == 0;
    ivec2 size = textureSize(first_source, 0);
    int y = int(gl_GlobalInvocationID.y), last = size.x - 1;
    if (y >= size.y) return;
    float factor = rows[y].factor, share = 1;
    vec4 mean = vec4(0), kept = mean;
    for (int first = 0; first <= last; first += side) {
        int own = first + int(gl_LocalInvocationID.x);
        for (int x = first; x <= min(first + side - 1, last); ++x) {
            ivec2 p = ivec2(x, y);
            vec4 texel = is_first ? texelFetch(first_source, p, 0) : texelFetch(second_source, p, 0);
            mean += share * (texel - mean);
            if (x == own) kept = mean;
            share = transmittance_weight_next(share, factor);
        }
        if (own > last) continue;
        if (is_first) imageStore(first_target, ivec2(own, y), kept);
        else imageStore(second_target, ivec2(own, y), kept);
    }
}
