// Projects triangles, for the shadow map and for the camera.
#version 450

layout(push_constant) uniform push { vec4 clip_rows[4]; };
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 albedo;
layout(location = 0) out vec3 world_position;
layout(location = 1) flat out vec3 world_normal;
layout(location = 2) flat out vec3 surface_albedo;

void main()
{
    vec4 p = vec4(position, 1);
    gl_Position = vec4(dot(clip_rows[0], p), dot(clip_rows[1], p), dot(clip_rows[2], p), dot(clip_rows[3], p));
    world_position = position;
    world_normal = normal;
    surface_albedo = albedo;
}
