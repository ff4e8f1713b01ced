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
    moments4 b = theta4(moments4_from_depth(depth_from_unit(texelFetch(depths, p, 0).x)));
    imageStore(map, p, vec4(b.b1, b.b2, b.b3, b.b4)); // the hardware rounds to 16 bits
}
