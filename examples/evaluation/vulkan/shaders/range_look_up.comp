// Shadow intensities of receivers in a map of resolved lists, a receiver for each invocation: static ones in one run, moving
// ones in another.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "moving_receiver.glsl"

layout(local_size_x = 64) in;
layout(binding = 0) readonly buffer all_first { uint first[]; };
layout(binding = 1) readonly buffer all_ranges { depth_time_range ranges[]; };
layout(binding = 2) readonly buffer all_receivers { receiver_path receivers[]; };
layout(binding = 3) writeonly buffer all_intensities { float intensities[]; };
layout(push_constant) uniform push
{
    uint begin, end; // of the receivers
    uint size;
    uint moves;
};
#include "range_look_up.h"

void main()
{
    uint i = begin + gl_GlobalInvocationID.x;
    if (i >= end) return;
    if (moves == 1) intensities[i] = moving_intensity(receivers[i]);
    else intensities[i] = static_intensity(receivers[i]);
}
