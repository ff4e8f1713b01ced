// A translucent fragment for the blend into a map of four channels in one image. Its opacity is a second source. glslang's
// HLSL has no word for that.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "method.glsl"
#include "puff.h"

layout(location = 0) in vec3 layer; // texture coordinates and opacity
layout(location = 0, index = 0) out vec4 above;
layout(location = 0, index = 1) out vec4 opacity;

void main()
{
    above = encode(depth_from_unit(gl_FragCoord.z)).first;
    opacity = vec4(layer.z * puff(layer.xy));
}
