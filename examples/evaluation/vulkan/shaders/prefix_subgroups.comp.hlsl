// prefix_subgroups.comp in HLSL.
#define vec4 float4
#include "rectified_row.h"
#include "weighted_mean.h"

static const uint invocations = 128;
[[vk::binding(0)]] Texture2D<float4> first_source;
[[vk::binding(1)]] Texture2D<float4> second_source;
[[vk::binding(2)]] RWTexture2D<float4> first_target;
[[vk::binding(3)]] RWTexture2D<float4> second_target;
[[vk::binding(4)]] StructuredBuffer<rectified_row> rows;

weighted_mean of_lane(weighted_mean own, uint lane)
{
    weighted_mean other;
    other.weight = WaveReadLaneAt(own.weight, lane);
    other.mean = WaveReadLaneAt(own.mean, lane);
    return other;
}

[numthreads(invocations, 1, 1)]
void main(uint3 thread : SV_GroupThreadID, uint3 group : SV_GroupID)
{
    bool is_first = group.z == 0;
    uint width, height;
    first_source.GetDimensions(width, height);
    uint lanes = WaveGetLaneCount(), lane = WaveGetLaneIndex();
    int y = int((group.y * invocations + thread.x) / lanes), last = int(width) - 1;
    if (y >= int(height)) return;
    float factor = rows[y].factor;
    float weight = power_of(factor, lane, lanes), block = factor * power_of(factor, lanes - 1, lanes);
    weighted_mean before; // of the texels left of the block
    before.weight = 0;
    before.mean = float4(0, 0, 0, 0);
    for (int first = 0; first <= last; first += int(lanes)) {
        int2 p = int2(first + int(lane), y);
        int3 loaded = int3(min(p.x, last), y, 0);
        weighted_mean own;
        own.weight = weight;
        own.mean = is_first ? first_source.Load(loaded) : second_source.Load(loaded);
        for (uint step = 1; step < lanes; step *= 2) {
            weighted_mean left = of_lane(own, (lane - step) & (lanes - 1));
            if (lane >= step) own = joined(left, own);
        }
        own = joined(before, own);
        before = relative_to(of_lane(own, lanes - 1), block);
        if (p.x > last) continue;
        if (is_first) first_target[p] = own.mean;
        else second_target[p] = own.mean;
    }
}
