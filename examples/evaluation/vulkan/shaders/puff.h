// Opacity of a puff of smoke over texture coordinates in [0, 1]^2, in the words that C++, GLSL and HLSL share: thick in
// the middle, none at the rim, with lumps.
float puff_wave(float x)
{
    float phase = x - floor(x);
    return 4 * phase * (1 - phase);
}

float puff(vec2 place)
{
    float x = 2 * place.x - 1, y = 2 * place.y - 1;
    float inside = max(1 - x * x - y * y, 0.0f);
    float lumps = puff_wave(2 * x + y) * puff_wave(2 * y - x / 2) / 2 + puff_wave(3 * y + 4 * x) / 4;
    return inside * (1 - lumps);
}
