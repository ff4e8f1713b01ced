// A number for each method of the example, the same in C++, GLSL and HLSL.
#define VSM_32 0
#define EVSM_64 1
#define EVSM_128 2
#define MSM_64 3
#define MSM_128 4
#define MSM6_60 5
#define MSM6_96 6
#define MSM6_192 7
