// Sums without a sample, in the words that GLSL and HLSL share.
layer_sums no_sums()
{
    layer_sums s;
    s.z = 0.0;
    s.zz = 0.0;
    s.opacity = 0.0;
    s.weight = 0.0;
    return s;
}
