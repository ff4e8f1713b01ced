// Prefix averages of the rows of a rectified map, by a scan in subgroups. A subgroup goes along a row, from block to block
// of one texel for each of its invocations, and weighs by the first texel of the block. Groups of z = 1 take the second
// image.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "rectified_row.h"
#include "weighted_mean.h"

layout(local_size_x = 128) in;
layout(binding = 0) uniform texture2D first_source;
layout(binding = 1) uniform texture2D second_source;
layout(binding = 2) writeonly uniform image2D first_target;
layout(binding = 3) writeonly uniform image2D second_target;
layout(binding = 4) readonly buffer all_rows { rectified_row rows[]; };

weighted_mean of_lane(weighted_mean own, uint lane)
{
    weighted_mean other;
    other.weight = subgroupShuffle(own.weight, lane);
    other.mean = subgroupShuffle(own.mean, lane);
    return other;
}

void main()
{
    bool is_first = gl_WorkGroupID.z == 0;
    ivec2 size = textureSize(first_source, 0);
    uint lanes = gl_SubgroupSize, lane = gl_SubgroupInvocationID;
    int y = int(gl_WorkGroupID.y * gl_NumSubgroups + gl_SubgroupID), last = size.x - 1;
    if (y >= size.y) return;
    float factor = rows[y].factor;
    float weight = power_of(factor, lane, lanes), block = factor * power_of(factor, lanes - 1, lanes);
    weighted_mean before; // of the texels left of the block
    before.weight = 0;
    before.mean = vec4(0);
    for (int first = 0; first <= last; first += int(lanes)) {
        ivec2 p = ivec2(first + int(lane), y), loaded = min(p, ivec2(last, y));
        weighted_mean own;
        own.weight = weight;
        own.mean = is_first ? texelFetch(first_source, loaded, 0) : texelFetch(second_source, loaded, 0);
        for (uint step = 1; step < lanes; step *= 2) {
            weighted_mean left = of_lane(own, (lane - step) & (lanes - 1));
            if (lane >= step) own = joined(left, own);
        }
        own = joined(before, own);
        before = relative_to(of_lane(own, lanes - 1), block);
        if (p.x > last) continue;
        if (is_first) imageStore(first_target, p, own.mean);
        else imageStore(second_target, p, own.mean);
    }
}
