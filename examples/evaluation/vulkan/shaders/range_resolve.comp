// Resolved lists: of each texel the ranges in front, disjoint and in order of time. The first run counts them, and the second
// writes them from the place that range_scan.comp has made of the counts.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "range_front.glsl"

layout(local_size_x = 64) in;
layout(binding = 0) readonly buffer all_first { uint first[]; };
layout(binding = 1) readonly buffer all_ranges { depth_time_range ranges[]; };
layout(binding = 2) buffer all_resolved_first { uint resolved_first[]; };
layout(binding = 3) writeonly buffer all_resolved { depth_time_range resolved[]; };
layout(push_constant) uniform push
{
    uint texels;
    uint fills;
};

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= texels) return;
    uint begin = first[i], end = first[i + 1], at = fills == 1 ? resolved_first[i] : 0;
    for (float t = 0; begin < end && t < 1;) {
        range_front state = range_front_begin(t);
        for (uint k = begin; k < end; ++k) state = range_front_compare(state, ranges[k]);
        for (uint k = begin; k < end; ++k) state = range_front_limit(state, ranges[k]);
        depth_time_range span = range_front_span(state);
        if (range_nothing < span.id) {
            if (fills == 1) resolved[at] = span;
            ++at;
        }
        t = span.t1;
    }
    if (fills == 0) resolved_first[i] = at;
}
