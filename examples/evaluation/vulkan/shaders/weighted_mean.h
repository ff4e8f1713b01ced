// The mean of a range of texels and its weight, in the words that GLSL and HLSL share once vec4 is known. Two adjacent
// ranges join to one; of several, any two neighbours may join first. Weights are relative to a texel that ranges to be joined
// have in common.
struct weighted_mean {
    float weight;
    vec4 mean;
};

weighted_mean joined(weighted_mean left, weighted_mean right)
{
    const float least = 1e-37; // of a sum, where both weights underflow
    weighted_mean both;
    both.weight = left.weight + right.weight;
    both.mean = left.mean + right.weight / max(both.weight, least) * (right.mean - left.mean);
    return both;
}

// The same range with its weight relative to a texel that weighs this much less; beyond most, a weight of most.
weighted_mean relative_to(weighted_mean range, float weight)
{
    const float most = 1e30;
    range.weight = min(range.weight / max(weight, 1 / most), most);
    return range;
}

// factor to the power of n, which is below limit, itself a power of two.
float power_of(float factor, uint n, uint limit)
{
    float result = 1;
    for (uint bit = 1; bit < limit; bit *= 2) {
        if ((n & bit) > 0) result *= factor;
        factor *= factor;
    }
    return result;
}
