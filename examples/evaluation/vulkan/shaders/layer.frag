// A translucent fragment for the blend into a map of four channels in two images. Its opacity is the alpha that both
// images lack.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "method.glsl"
#include "puff.h"

layout(location = 0) in vec3 layer; // texture coordinates and opacity
layout(location = 0) out vec4 above_first;
layout(location = 1) out vec4 above_second;

void main()
{
    texel t = encode(depth_from_unit(gl_FragCoord.z));
    float alpha = layer.z * puff(layer.xy);
    above_first = vec4(t.first.xy, 0, alpha);
    above_second = vec4(t.second.xy, 0, alpha);
}
