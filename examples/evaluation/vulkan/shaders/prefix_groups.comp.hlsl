// prefix_groups.comp in HLSL.
#include "gnomon.hlsl"
#include "rectified_row.h"

static const int side = 8;
[[vk::binding(0)]] Texture2D<float4> first_source;
[[vk::binding(1)]] Texture2D<float4> second_source;
[[vk::binding(2)]] RWTexture2D<float4> first_target;
[[vk::binding(3)]] RWTexture2D<float4> second_target;
[[vk::binding(4)]] StructuredBuffer<rectified_row> rows;

[numthreads(side, side, 1)]
void main(uint3 thread : SV_GroupThreadID, uint3 group : SV_GroupID)
{
    bool is_first = group.z == 0;
    uint width, height;
    first_source.GetDimensions(width, height);
    int y = int(group.y * side + thread.y), last = int(width) - 1;
    if (y >= int(height)) return;
    float factor = rows[y].factor, share = 1;
    float4 mean = float4(0, 0, 0, 0), kept = mean;
    for (int first = 0; first <= last; first += side) {
        int own = first + int(thread.x);
        for (int x = first; x <= min(first + side - 1, last); ++x) {
            int3 p = int3(x, y, 0);
            float4 texel = is_first ? first_source.Load(p) : second_source.Load(p);
            mean += share * (texel - mean);
            if (x == own) kept = mean;
            share = transmittance_weight_next(share, factor);
        }
        if (own > last) continue;
        if (is_first) first_target[int2(own, y)] = kept;
        else second_target[int2(own, y)] = kept;
    }
}
