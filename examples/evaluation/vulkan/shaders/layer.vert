// Translucent triangles for the shadow map.
#version 450

layout(push_constant) uniform push { vec4 clip_rows[4]; };
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 surface; // texture coordinates and opacity
layout(location = 0) out vec3 layer;

void main()
{
    vec4 p = vec4(position, 1);
    gl_Position = vec4(dot(clip_rows[0], p), dot(clip_rows[1], p), dot(clip_rows[2], p), dot(clip_rows[3], p));
    layer = surface;
}
