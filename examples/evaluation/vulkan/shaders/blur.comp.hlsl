// blur.comp in HLSL.
[[vk::binding(0)]] Texture2D<float4> source;
[[vk::binding(1)]] RWTexture2D<float4> target;
[[vk::binding(2)]] StructuredBuffer<float> weights;
[[vk::push_constant]] cbuffer push
{
    int2 direction;
    int radius, last;
};

[numthreads(8, 8, 1)]
void main(uint3 id : SV_DispatchThreadID)
{
    float4 sum = float4(0, 0, 0, 0);
    for (int i = -radius; i <= radius; ++i)
        sum += weights[i + radius] * source.Load(int3(clamp(int2(id.xy) + i * direction, 0, last), 0));
    target[id.xy] = sum;
}
