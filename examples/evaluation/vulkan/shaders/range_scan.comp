// Counts of lists become the places where they begin, and after the last one the sum of all, by one workgroup.
#version 450

const uint invocations = 256;
layout(local_size_x = invocations) in;
layout(binding = 0) buffer all_first { uint first[]; };
layout(push_constant) uniform push { uint lists; };
shared uint sums[invocations];

void main()
{
    uint i = gl_LocalInvocationID.x, own = (lists + invocations - 1) / invocations;
    uint begin = min(i * own, lists), end = min(begin + own, lists), total = 0;
    for (uint k = begin; k < end; ++k) total += first[k];
    uint sum = total;
    for (uint step = 1; step < invocations; step *= 2) {
        sums[i] = sum;
        barrier();
        if (i >= step) sum += sums[i - step];
        barrier();
    }
    uint at = sum - total;
    for (uint k = begin; k < end; ++k) {
        uint count = first[k];
        first[k] = at;
        at += count;
    }
    if (i == invocations - 1) first[lists] = at;
}
