// range_resolve.comp in HLSL.
#include "range_front.hlsl"

[[vk::binding(0)]] StructuredBuffer<uint> first;
[[vk::binding(1)]] StructuredBuffer<depth_time_range> ranges;
[[vk::binding(2)]] RWStructuredBuffer<uint> resolved_first;
[[vk::binding(3)]] RWStructuredBuffer<depth_time_range> resolved;
[[vk::push_constant]] cbuffer push
{
    uint texels;
    uint fills;
};

[numthreads(64, 1, 1)]
void main(uint3 id : SV_DispatchThreadID)
{
    uint i = id.x;
    if (i >= texels) return;
    uint begin = first[i], end = first[i + 1], at = fills == 1 ? resolved_first[i] : 0;
    for (float t = 0; begin < end && t < 1;) {
        range_front state = range_front_begin(t);
        for (uint k = begin; k < end; ++k) state = range_front_compare(state, ranges[k]);
        for (uint j = begin; j < end; ++j) state = range_front_limit(state, ranges[j]);
        depth_time_range span = range_front_span(state);
        if (range_nothing < span.id) {
            if (fills == 1) resolved[at] = span;
            ++at;
        }
        t = span.t1;
    }
    if (fills == 0) resolved_first[i] = at;
}
