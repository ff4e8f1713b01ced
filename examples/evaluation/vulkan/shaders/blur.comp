// One pass of a separable blur; beyond the edge the outermost texel repeats.
#version 450
#extension GL_EXT_samplerless_texture_functions : require

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform texture2D source;
layout(binding = 1) writeonly uniform image2D target;
layout(binding = 2) readonly buffer taps { float weights[]; };
layout(push_constant) uniform push
{
    ivec2 direction;
    int radius, last; // last texel of a row
};

void main()
{
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    vec4 sum = vec4(0);
    for (int i = -radius; i <= radius; ++i)
        sum += weights[i + radius] * texelFetch(source, clamp(p + i * direction, ivec2(0), ivec2(last)), 0);
    imageStore(target, p, sum);
}
