// One pass of a summed-area table: the running sums of each line of texels, modulo 2^32. A workgroup takes a line, a block
// of texels at a time. The pass along rows reads channels and turns them into codes (GNOMON_FROM_CHANNELS), the pass along
// columns reads what that one wrote.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "gnomon.glsl"

const int block = 128;
layout(local_size_x = block) in;
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
shared uvec4 sums[block];

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
    uvec4 before = uvec4(0); // the sum of all blocks before this one
    for (int first = 0; first < size; first += block) {
        ivec2 p = line + (first + i) * direction;
        bool inside = first + i < size;
        uvec4 sum = uvec4(0);
        if (inside) sum = texel_at(p);
        for (int step = 1; step < block; step *= 2) {
            sums[i] = sum;
            barrier();
            if (i >= step) sum += sums[i - step];
            barrier();
        }
        sums[i] = sum;
        if (inside) imageStore(target, p, before + sum);
        barrier();
        before += sums[block - 1];
        barrier();
    }
}
