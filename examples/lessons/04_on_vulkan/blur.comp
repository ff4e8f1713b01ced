// One pass of the blur; beyond the edge the outermost texel repeats.
#version 450
#extension GL_EXT_samplerless_texture_functions : require

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform texture2D source;
layout(binding = 1) writeonly uniform image2D target;
layout(binding = 2) readonly buffer taps { float weights[]; };
layout(push_constant) uniform push { ivec2 step; };

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy), last = textureSize(source, 0) - 1;
    int radius = weights.length() / 2;
    vec4 sum = vec4(0);
    for (int i = -radius; i <= radius; ++i)
        sum += weights[i + radius] * texelFetch(source, clamp(p + i * step, ivec2(0), last), 0);
    imageStore(target, p, sum);
}
