// What the methods differ in, in the words that GLSL and HLSL share once vec4 is known: what the map stores of a depth,
// and the shadow intensity from what the sampler returns. A moment format's transform and bias come with its kernels;
// the settings of variance and exponential variance shadow maps are specialization constants, set from the C++ formats.
#include "method_id.h"

// The channels of one or two images.
struct texel {
    vec4 first, second;
};

variance_settings settings_of_variance()
{
    variance_settings s;
    s.minimum_variance = setting0;
    return s;
}

exponential_variance_settings settings_of_exponential_variance()
{
    exponential_variance_settings s;
    s.positive_exponent = setting0;
    s.negative_exponent = setting1;
    s.minimum_variance = setting2;
    return s;
}

channels4 channels4_of(texel t)
{
    channels4 c;
    c.c1 = t.first.x;
    c.c2 = t.first.y;
    c.c3 = t.first.z;
    c.c4 = t.first.w;
    return c;
}

// Of two 10-10-10-2 words the first has the first three channels, else the first image has four.
channels6 channels6_of(texel t)
{
    channels6 c;
    c.c1 = t.first.x;
    c.c2 = t.first.y;
    c.c3 = t.first.z;
    c.c4 = method == MSM6_60 ? t.second.x : t.first.w;
    c.c5 = method == MSM6_60 ? t.second.y : t.second.x;
    c.c6 = method == MSM6_60 ? t.second.z : t.second.y;
    return c;
}

texel texel_of(channels6 c)
{
    texel t;
    t.first = vec4(c.c1, c.c2, c.c3, c.c4);
    t.second = method == MSM6_60 ? vec4(c.c4, c.c5, c.c6, 0) : vec4(c.c5, c.c6, 0, 0);
    return t;
}

// What filters average.
texel moments_of_depth(float z)
{
    texel t = texel_of(channels6_from_moments(moments6_from_depth(z)));
    if (method == EVSM_64 || method == EVSM_128) {
        exponential_variance_moments b = exponential_variance_encode(z, settings_of_exponential_variance());
        t.first = vec4(b.positive, b.positive_square, b.negative, b.negative_square);
    }
    return t;
}

// The format's transform.
texel encode(texel mean)
{
    if (method == VSM_32) mean.first.x = 0.5 * mean.first.x + 0.5;
    if (method == MSM_64) {
        channels4 c = theta4(moments4_from_channels(channels4_of(mean)));
        mean.first = vec4(c.c1, c.c2, c.c3, c.c4);
    }
    if (method == MSM6_60 || method == MSM6_96) mean = texel_of(theta6(moments6_from_channels(channels6_of(mean))));
    return mean;
}

float intensity(texel filtered, float z_f)
{
    if (method == VSM_32) {
        variance_moments b;
        b.mean = 2.0 * filtered.first.x - 1.0;
        b.square = filtered.first.y;
        return variance_intensity(b, z_f, settings_of_variance());
    }
    if (method == EVSM_64 || method == EVSM_128) {
        exponential_variance_moments b;
        b.positive = filtered.first.x;
        b.positive_square = filtered.first.y;
        b.negative = filtered.first.z;
        b.negative_square = filtered.first.w;
        return exponential_variance_intensity(b, z_f, settings_of_exponential_variance());
    }
    if (method == MSM_64) return moments4_unorm16_filtered_intensity(channels4_of(filtered), z_f);
    if (method == MSM_128) return moments4_float_filtered_intensity(channels4_of(filtered), z_f);
    if (method == MSM6_60) return moments6_unorm10_filtered_intensity(channels6_of(filtered), z_f);
    if (method == MSM6_96) return moments6_unorm16_filtered_intensity(channels6_of(filtered), z_f);
    return moments6_float_filtered_intensity(channels6_of(filtered), z_f);
}
