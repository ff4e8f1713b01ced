// layer_accumulate.comp in HLSL.
#include "layer_look_up.hlsl"
#include "layer_sums.hlsl"
#include "layer_hlsl.h"
#define vec2 float2

static const int invocations = 64, batch = 576; // a window of 12 x 12 texels of 4 samples each
[[vk::binding(0)]] StructuredBuffer<stochastic_sample> all_samples;
[[vk::binding(1)]] StructuredBuffer<tile_layers> tiles;
[[vk::binding(2)]] StructuredBuffer<uint> first;
[[vk::binding(3)]] RWStructuredBuffer<layer_grid> grids;
[[vk::binding(4)]] RWStructuredBuffer<layer_sums> layer_texels;
[[vk::push_constant]] cbuffer push { layer_push given; };
groupshared uint first_sample[4];
groupshared gnomon_layer_motion_sums motions[64];
groupshared layer_grid tile_grids[4];
groupshared layer_sums texels[85];
groupshared int texel_of[batch], next_in_row[batch], first_in_row[8];
groupshared float depth_of[batch], opacity_of[batch];
#define const static const
#include "layer_window.h"
#include "layer_no_sums.h"
#include "layer_accumulate.h"
#undef const

[numthreads(64, 1, 1)]
void main(uint3 group : SV_GroupID, uint3 thread : SV_GroupThreadID) { accumulate_tile(group.x, thread.x); }
