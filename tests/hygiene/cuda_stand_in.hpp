// The few names of CUDA that the example in docs/shaders.md uses, for a C++ compiler.
#pragma once
struct float4 {
    float x, y, z, w;
};
inline float4 make_float4(float x, float y, float z, float w) { return {x, y, z, w}; }
struct dim3 {
    int x;
};
inline constexpr dim3 blockIdx{0}, blockDim{1}, threadIdx{0};
