// running_sums.comp in HLSL.
#include "gnomon.hlsl"

static const int invocations = 128, texels = 8;
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
groupshared uint4 sums[invocations];

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

[numthreads(invocations, 1, 1)]
void main(uint3 thread : SV_GroupThreadID, uint3 group : SV_GroupID)
{
    int i = int(thread.x);
    int2 row = int(group.x) * direction.yx;
    uint4 before = uint4(0, 0, 0, 0); // the sum over what was taken earlier
    for (int first = i * texels; first - i * texels < size; first += invocations * texels) {
        uint4 own[texels], total = uint4(0, 0, 0, 0);
        for (int k = 0; k < texels; ++k) {
            if (first + k < size) total += texel_at(row + (first + k) * direction);
            own[k] = total;
        }
        uint4 sum = total;
        for (int step = 1; step < invocations; step *= 2) {
            sums[i] = sum;
            GroupMemoryBarrierWithGroupSync();
            if (i >= step) sum += sums[i - step];
            GroupMemoryBarrierWithGroupSync();
        }
        sums[i] = sum;
        GroupMemoryBarrierWithGroupSync();
        uint4 start = before + sum - total;
        for (int j = 0; j < texels; ++j)
            if (first + j < size) target[row + (first + j) * direction] = start + own[j];
        before += sums[invocations - 1];
        GroupMemoryBarrierWithGroupSync();
    }
}
