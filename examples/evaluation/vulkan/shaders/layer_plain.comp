// A level of the plain map of a layered shadow map, a texel for each invocation.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "layer_sums.glsl"
#include "layer_sizes.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) readonly buffer samples_buffer { stochastic_sample all_samples[]; };
layout(binding = 1) readonly buffer blocks_buffer { uint blocks[]; };
layout(binding = 2) buffer plain_buffer { layer_sums plain[]; };
layout(push_constant) uniform push { layer_push given; };
#include "layer_no_sums.h"
#include "layer_plain.h"

void main() { fill_plain(gl_GlobalInvocationID.x, gl_GlobalInvocationID.y); }
