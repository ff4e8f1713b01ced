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

moments4 moments4_of(texel t)
{
    moments4 b;
    b.b1 = t.first.x;
    b.b2 = t.first.y;
    b.b3 = t.first.z;
    b.b4 = t.first.w;
    return b;
}

// Of two 10-10-10-2 words the first has the first three channels, else the first image has four.
moments6 moments6_of(texel t)
{
    moments6 b;
    b.b1 = t.first.x;
    b.b2 = t.first.y;
    b.b3 = t.first.z;
    b.b4 = method == MSM6_60 ? t.second.x : t.first.w;
    b.b5 = method == MSM6_60 ? t.second.y : t.second.x;
    b.b6 = method == MSM6_60 ? t.second.z : t.second.y;
    return b;
}

texel texel_of(moments6 b)
{
    texel t;
    t.first = vec4(b.b1, b.b2, b.b3, b.b4);
    t.second = method == MSM6_60 ? vec4(b.b4, b.b5, b.b6, 0) : vec4(b.b5, b.b6, 0, 0);
    return t;
}

// What filters average.
texel moments_of_depth(float z)
{
    texel t = texel_of(moments6_from_depth(z));
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
        moments4 c = theta4(moments4_of(mean));
        mean.first = vec4(c.b1, c.b2, c.b3, c.b4);
    }
    if (method == MSM6_60 || method == MSM6_96) mean = texel_of(theta6(moments6_of(mean)));
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
    if (method == MSM_64) return certified4_unorm16_filtered(moments4_of(filtered), z_f);
    if (method == MSM_128) return certified4_float_filtered(moments4_of(filtered), z_f);
    if (method == MSM6_60) return hamburger6_lower(hankel6_from_unorm10_filtered(moments6_of(filtered)), z_f);
    if (method == MSM6_96) return hamburger6_lower(hankel6_from_unorm16_filtered(moments6_of(filtered)), z_f);
    return hamburger6_lower(hankel6_from_float_filtered(moments6_of(filtered)), z_f);
}
