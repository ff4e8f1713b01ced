// From four depths to one texel: the mean of their channels (Peters et al. 2017, D.1).
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "method.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform texture2DMS depths;
layout(binding = 1) writeonly uniform image2D first_map;
layout(binding = 2) writeonly uniform image2D second_map;

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    texel mean = texel(vec4(0), vec4(0));
    for (int i = 0; i < 4; ++i) {
        texel t = encode(depth_from_unit(texelFetch(depths, p, i).x));
        mean.first += 0.25 * t.first;
        mean.second += 0.25 * t.second;
    }
    imageStore(first_map, p, mean.first);
#if GNOMON_METHOD_IMAGES == 2
    imageStore(second_map, p, mean.second);
#endif
}
