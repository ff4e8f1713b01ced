// range_scan.comp in HLSL.
static const uint invocations = 256;
[[vk::binding(0)]] RWStructuredBuffer<uint> first;
[[vk::push_constant]] cbuffer push { uint lists; };
groupshared uint sums[invocations];

[numthreads(invocations, 1, 1)]
void main(uint3 thread : SV_GroupThreadID)
{
    uint i = thread.x, own = (lists + invocations - 1) / invocations;
    uint begin = min(i * own, lists), end = min(begin + own, lists), total = 0;
    for (uint k = begin; k < end; ++k) total += first[k];
    uint sum = total;
    for (uint step = 1; step < invocations; step *= 2) {
        sums[i] = sum;
        GroupMemoryBarrierWithGroupSync();
        if (i >= step) sum += sums[i - step];
        GroupMemoryBarrierWithGroupSync();
    }
    uint at = sum - total;
    for (uint j = begin; j < end; ++j) {
        uint count = first[j];
        first[j] = at;
        at += count;
    }
    if (i == invocations - 1) first[lists] = at;
}
