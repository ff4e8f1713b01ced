// A texel of the plain map, in the words that GLSL and HLSL share: the sums of its samples, all in one layer, or the mean of four
// texels of the level before. Levels are stored one after the other. Blocks that no tile looks up stay empty.
uint level_begin(uint level)
{
    uint begin = 0;
    for (uint l = 0; l < level; ++l) begin += (given.width >> l) * (given.width >> l);
    return begin;
}

layer_sums plain_texel(uint x, uint y)
{
    layer_sums sums = no_sums();
    if (given.level == 0) {
        gnomon_layer_cuts none;
        none.c0 = 3.0;
        none.c1 = 3.0;
        none.c2 = 3.0;
        for (uint k = 0; k < given.samples; ++k) {
            stochastic_sample s = all_samples[(y * given.width + x) * given.samples + k];
            sums = layer_sums_add(sums, s.z, layer_share_of(layer_of(layer_middle_depth(s), none), 0.0));
        }
        return sums;
    }
    uint before = level_begin(given.level - 1), extent = given.width >> (given.level - 1);
    for (uint k = 0; k < 4; ++k) {
        layer_sums s = plain[before + (2 * y + k / 2) * extent + 2 * x + k % 2];
        sums.z = sums.z + 0.25 * s.z;
        sums.zz = sums.zz + 0.25 * s.zz;
        sums.opacity = sums.opacity + 0.25 * s.opacity;
        sums.weight = sums.weight + 0.25 * s.weight;
    }
    return sums;
}

void fill_plain(uint x, uint y)
{
    uint extent = given.width >> given.level, side = uint(layer_block) >> given.level;
    if (x >= extent || y >= extent) return;
    bool stored = blocks[y / side * (given.width / uint(layer_block)) + x / side] == 1;
    uint place = level_begin(given.level) + y * extent + x;
    if (stored) plain[place] = plain_texel(x, y);
    else plain[place] = no_sums();
}
