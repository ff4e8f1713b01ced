// running_sums.comp in HLSL.
#include "gnomon.hlsl"

static const int block = 128;
#ifdef GNOMON_FROM_CHANNELS
[[vk::binding(0)]] Texture2D<float4> source;
#else
[[vk::binding(0)]] Texture2D<uint4> source;
#endif
[[vk::binding(1)]] RWTexture2D<uint4> target;
[[vk::push_constant]] cbuffer push
{
    int2 direction;
    int size; // of a line, in texels
    float scale;
};
groupshared uint4 sums[block];

uint4 texel_at(int2 p)
{
#ifdef GNOMON_FROM_CHANNELS
    float4 t = source.Load(int3(p, 0));
    channels4 c = {t.x, t.y, t.z, t.w};
    c = moments4_summed_codes(c, scale);
    return uint4(c.c1, c.c2, c.c3, c.c4);
#else
    return source.Load(int3(p, 0));
#endif
}

[numthreads(block, 1, 1)]
void main(uint3 thread : SV_GroupThreadID, uint3 group : SV_GroupID)
{
    int i = int(thread.x);
    int2 row = int(group.x) * direction.yx;
    uint4 before = uint4(0, 0, 0, 0); // the sum of all blocks before this one
    for (int first = 0; first < size; first += block) {
        int2 p = row + (first + i) * direction;
        bool inside = first + i < size;
        uint4 sum = uint4(0, 0, 0, 0);
        if (inside) sum = texel_at(p);
        for (int step = 1; step < block; step *= 2) {
            sums[i] = sum;
            GroupMemoryBarrierWithGroupSync();
            if (i >= step) sum += sums[i - step];
            GroupMemoryBarrierWithGroupSync();
        }
        sums[i] = sum;
        if (inside) target[p] = before + sum;
        GroupMemoryBarrierWithGroupSync();
        before += sums[block - 1];
        GroupMemoryBarrierWithGroupSync();
    }
}
