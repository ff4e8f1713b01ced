// The grids of the layers of all tiles, and their texels with mips. A workgroup takes a tile.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "layer_look_up.glsl"
#include "layer_sums.glsl"
#include "layer_sizes.h"

const int invocations = 64, batch = 576; // a window of 12 x 12 texels of 4 samples each
layout(local_size_x = 64) in;
layout(binding = 0) readonly buffer samples_buffer { stochastic_sample all_samples[]; };
layout(binding = 1) readonly buffer tiles_buffer { tile_layers tiles[]; };
layout(binding = 2) readonly buffer first_buffer { uint first[]; };
layout(binding = 3) writeonly buffer grids_buffer { layer_grid grids[]; };
layout(binding = 4) writeonly buffer texels_buffer { layer_sums layer_texels[]; };
layout(push_constant) uniform push { layer_push given; };
shared uint first_sample[4];
shared gnomon_layer_motion_sums motions[64];
shared layer_grid tile_grids[4];
shared layer_sums texels[85];
shared int texel_of[batch], next_in_row[batch], first_in_row[8];
shared float depth_of[batch], opacity_of[batch];
#include "layer_window.h"
#include "layer_no_sums.h"
#include "layer_accumulate.h"

void main() { accumulate_tile(gl_WorkGroupID.x, gl_LocalInvocationID.x); }
