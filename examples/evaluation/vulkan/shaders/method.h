// The texel of a method in one image or two, in the words that GLSL and HLSL share once vec4 is known. The build compiles
// the shaders for each method with these macros, from the method's device form:
//     GNOMON_METHOD_ENCODE, GNOMON_METHOD_INTENSITY    kernels of the storage format
//     GNOMON_METHOD_IMAGES                             1 or 2
//     GNOMON_METHOD_FIRST                              channels in the first image
//     GNOMON_METHOD_CHANNELS                           channels in all images

struct texel {
    vec4 first, second;
};

#if GNOMON_METHOD_CHANNELS == 1
texel texel_of(channels1 c)
{
    texel t;
    t.first = vec4(c.c1, 0, 0, 0);
    t.second = vec4(0, 0, 0, 0);
    return t;
}

channels1 channels_of(texel t)
{
    channels1 c;
    c.c1 = t.first.x;
    return c;
}
#elif GNOMON_METHOD_CHANNELS == 2
texel texel_of(channels2 c)
{
    texel t;
    t.first = vec4(c.c1, c.c2, 0, 0);
    t.second = vec4(0, 0, 0, 0);
    return t;
}

channels2 channels_of(texel t)
{
    channels2 c;
    c.c1 = t.first.x;
    c.c2 = t.first.y;
    return c;
}
#elif GNOMON_METHOD_CHANNELS == 4 && GNOMON_METHOD_FIRST == 2
texel texel_of(channels4 c)
{
    texel t;
    t.first = vec4(c.c1, c.c2, 0, 0);
    t.second = vec4(c.c3, c.c4, 0, 0);
    return t;
}

channels4 channels_of(texel t)
{
    channels4 c;
    c.c1 = t.first.x;
    c.c2 = t.first.y;
    c.c3 = t.second.x;
    c.c4 = t.second.y;
    return c;
}
#elif GNOMON_METHOD_CHANNELS == 4
texel texel_of(channels4 c)
{
    texel t;
    t.first = vec4(c.c1, c.c2, c.c3, c.c4);
    t.second = vec4(0, 0, 0, 0);
    return t;
}

channels4 channels_of(texel t)
{
    channels4 c;
    c.c1 = t.first.x;
    c.c2 = t.first.y;
    c.c3 = t.first.z;
    c.c4 = t.first.w;
    return c;
}
#elif GNOMON_METHOD_FIRST == 3
texel texel_of(channels6 c)
{
    texel t;
    t.first = vec4(c.c1, c.c2, c.c3, 0);
    t.second = vec4(c.c4, c.c5, c.c6, 0);
    return t;
}

channels6 channels_of(texel t)
{
    channels6 c;
    c.c1 = t.first.x;
    c.c2 = t.first.y;
    c.c3 = t.first.z;
    c.c4 = t.second.x;
    c.c5 = t.second.y;
    c.c6 = t.second.z;
    return c;
}
#else
texel texel_of(channels6 c)
{
    texel t;
    t.first = vec4(c.c1, c.c2, c.c3, c.c4);
    t.second = vec4(c.c5, c.c6, 0, 0);
    return t;
}

channels6 channels_of(texel t)
{
    channels6 c;
    c.c1 = t.first.x;
    c.c2 = t.first.y;
    c.c3 = t.first.z;
    c.c4 = t.first.w;
    c.c5 = t.second.x;
    c.c6 = t.second.y;
    return c;
}
#endif

texel encode(float z) { return texel_of(GNOMON_METHOD_ENCODE(z)); }

float intensity(texel filtered, float z_f) { return GNOMON_METHOD_INTENSITY(channels_of(filtered), z_f); }
