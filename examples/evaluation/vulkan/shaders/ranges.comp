// The lists of ranges of a shadow map, a texel for each invocation. The first run counts the ranges of each texel, and the
// second writes them from the place that range_scan.comp has made of the counts.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "edge_widening.glsl"
#include "range.glsl"
#include "tile_record.h"

layout(local_size_x = 64) in;
layout(binding = 0) readonly buffer all_records { tile_record records[]; };
layout(binding = 1) readonly buffer all_blocks { uint blocks[]; }; // where the members of each block begin
layout(binding = 2) readonly buffer all_members { uint members[]; };
layout(binding = 3) buffer all_first { uint first[]; };
layout(binding = 4) writeonly buffer all_ranges { depth_time_range ranges[]; };
layout(push_constant) uniform push
{
    uint texels;
    uint fills;
    float tolerance;
};
#include "ranges_of_texel.h"

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= texels) return;
    uint at = add_texel(fills == 1 ? first[i] : 0, i, blocks[i / 16], blocks[i / 16 + 1]);
    if (fills == 0) first[i] = at;
}
