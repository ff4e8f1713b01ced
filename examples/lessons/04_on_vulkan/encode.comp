// Turns each depth into a texel of the moment shadow map.
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "moments4.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform texture2D depths;
layout(binding = 1) writeonly uniform image2D map;

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    channels4 c = moments4_unorm16_encode(depth_from_unit(texelFetch(depths, p, 0).x));
    imageStore(map, p, vec4(c.c1, c.c2, c.c3, c.c4)); // the hardware rounds to 16 bits
}
