// layer_cluster.comp in HLSL.
#include "layer_clusters.hlsl"
#include "layer_hlsl.h"

static const uint invocations = 64;
[[vk::binding(0)]] StructuredBuffer<stochastic_sample> all_samples;
[[vk::binding(1)]] RWStructuredBuffer<tile_layers> tiles;
[[vk::binding(2)]] RWStructuredBuffer<uint> first;
[[vk::binding(3)]] RWStructuredBuffer<uint> blocks;
[[vk::push_constant]] cbuffer push { layer_push given; };
groupshared float least[invocations], greatest[invocations];
groupshared uint any_moves, bins[2];
#include "layer_window.h"
#include "layer_cluster.h"

[numthreads(64, 1, 1)]
void main(uint3 group : SV_GroupID, uint3 thread : SV_GroupThreadID) { cluster_tile(group.x, thread.x); }
