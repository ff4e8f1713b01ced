// One pass of a summed-area table: the running sums of each line of texels, modulo 2^32. A workgroup takes a line, some
// texels for each invocation at a time. The pass along rows reads channels and turns them into codes (GNOMON_FROM_CHANNELS), the pass along
// columns reads what that one wrote.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "gnomon.glsl"

const int invocations = 128, texels = 8;
layout(local_size_x = invocations) in;
#ifdef GNOMON_FROM_CHANNELS
layout(binding = 0) uniform texture2D source;
#else
layout(binding = 0) uniform utexture2D source;
#endif
layout(binding = 1) writeonly uniform uimage2D target;
layout(push_constant) uniform push
{
    ivec2 direction;
    int size; // of a line, in texels
    float scale;
};
shared uvec4 sums[invocations];

uvec4 texel_at(ivec2 p)
{
#ifdef GNOMON_FROM_CHANNELS
    vec4 t = texelFetch(source, p, 0);
    channels4 c = moments4_summed_codes(channels4(t.x, t.y, t.z, t.w), scale);
    return uvec4(c.c1, c.c2, c.c3, c.c4);
#else
    return texelFetch(source, p, 0);
#endif
}

void main()
{
    int i = int(gl_LocalInvocationID.x);
    ivec2 line = int(gl_WorkGroupID.x) * direction.yx;
    uvec4 before = uvec4(0); // the sum over what was taken earlier
    for (int first = i * texels; first - i * texels < size; first += invocations * texels) {
        uvec4 own[texels], total = uvec4(0);
        for (int k = 0; k < texels; ++k) {
            if (first + k < size) total += texel_at(line + (first + k) * direction);
            own[k] = total;
        }
        uvec4 sum = total;
        for (int step = 1; step < invocations; step *= 2) {
            sums[i] = sum;
            barrier();
            if (i >= step) sum += sums[i - step];
            barrier();
        }
        sums[i] = sum;
        barrier();
        uvec4 start = before + sum - total;
        for (int k = 0; k < texels; ++k)
            if (first + k < size) imageStore(target, line + (first + k) * direction, start + own[k]);
        before += sums[invocations - 1];
        barrier();
    }
}
