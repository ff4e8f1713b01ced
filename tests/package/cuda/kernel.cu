#if __has_include("gnomon.cuh")
#include "gnomon.cuh"
#else
#include <gnomon/gnomon.h>
#endif

__global__ void shade(const gnomon::channels4<float>* texels, const float* depths, float* intensities)
{
    const int i = blockIdx.x * blockDim.x + threadIdx.x;
    intensities[i] = gnomon::moments4_float_intensity(texels[i], depths[i]);
}
