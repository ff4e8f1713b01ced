// The smallest use: how much shadow falls on a receiver between two equally frequent occluder depths.
#include <cstdio>

#if __has_include("gnomon.cuh")
#include "gnomon.cuh" // the include path is that of the shader packages
#else
#include <gnomon/gnomon.h>
#endif

int main()
{
    const auto near_moments = gnomon::moments4_from_depth(-0.5f);
    const auto far_moments = gnomon::moments4_from_depth(0.5f);
    const auto filtered = gnomon::moments4_add(gnomon::moments4_scale(near_moments, 0.5f), far_moments, 0.5f);
    const float intensity = gnomon::moments4_float_intensity(gnomon::channels4_from_moments(filtered), 0.0f);
    std::printf("shadow intensity %f\n", static_cast<double>(intensity));
    return intensity > 0.49f && intensity <= 0.5f ? 0 : 1;
}
