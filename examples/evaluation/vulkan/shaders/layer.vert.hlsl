// layer.vert in HLSL.
[[vk::push_constant]] cbuffer push { float4 clip_rows[4]; };

struct vertex {
    [[vk::location(0)]] float3 position : POSITION;
    [[vk::location(1)]] float3 surface : TEXCOORD;
};

struct fragment {
    float4 clip_position : SV_Position;
    [[vk::location(0)]] float3 surface : TEXCOORD;
};

fragment main(vertex v)
{
    float4 p = float4(v.position, 1);
    fragment f;
    f.clip_position =
        float4(dot(clip_rows[0], p), dot(clip_rows[1], p), dot(clip_rows[2], p), dot(clip_rows[3], p));
    f.surface = v.surface;
    return f;
}
