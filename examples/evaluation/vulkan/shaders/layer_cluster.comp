// How many layers each tile has, and which depths. A workgroup takes a tile.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "layer_clusters.glsl"
#include "layer_sizes.h"

const uint invocations = 64;
layout(local_size_x = invocations) in;
layout(binding = 0) readonly buffer samples_buffer { stochastic_sample all_samples[]; };
layout(binding = 1) writeonly buffer tiles_buffer { tile_layers tiles[]; };
layout(binding = 2) writeonly buffer first_buffer { uint first[]; };
layout(binding = 3) writeonly buffer blocks_buffer { uint blocks[]; };
layout(push_constant) uniform push { layer_push given; };
shared float least[invocations], greatest[invocations];
shared uint any_moves, bins[2];
#include "layer_window.h"
#include "layer_cluster.h"

void main() { cluster_tile(gl_WorkGroupID.x, gl_LocalInvocationID.x); }
