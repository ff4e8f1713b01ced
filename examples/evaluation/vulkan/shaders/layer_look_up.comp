// Shadow intensities of receivers in a layered map, a receiver for each invocation.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "layer_look_up.glsl"
#include "layer_sums.glsl"
#include "layer_sizes.h"

layout(push_constant) uniform push { layer_push given; };
layout(local_size_x = 64) in;
layout(binding = 0) readonly buffer first_buffer { uint first[]; };
layout(binding = 1) readonly buffer grids_buffer { layer_grid grids[]; };
layout(binding = 2) readonly buffer texels_buffer { layer_sums layer_texels[]; };
layout(binding = 3) readonly buffer blocks_buffer { uint blocks[]; };
layout(binding = 4) readonly buffer plain_buffer { layer_sums plain[]; };
#include "layer_look_up.h"
layout(binding = 5) readonly buffer receivers_buffer { layer_receiver receivers[]; };
layout(binding = 6) writeonly buffer intensities_buffer { float intensities[]; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i < given.receivers) intensities[i] = layer_intensity(receivers[i]);
}
