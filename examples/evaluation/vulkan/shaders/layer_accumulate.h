// The layers of a tile by one workgroup (Andersson et al. 2015, Sec. 4.1), in the words that GLSL and HLSL share: their mean
// motions, their grids, the sums of their texels, evened out and blurred across fast motion, and their mips. Sums are in the order
// of the CPU's passes: of motions in 16 parts for each layer, of texels sample by sample.
const int motion_parts = 16, texels_of_layer = 85;

// The layer's motion: 16 invocations for each of 4 layers take every 16th sample.
void find_grids(tile_window w, tile_layers tile, uint begin, uint i)
{
    gnomon_layer_cuts cuts = cuts_of(tile);
    int layer = int(i) / motion_parts, part = int(i) % motion_parts, none = w.samples;
    if (i < 4) first_sample[i] = uint(none);
    barrier();
    for (int n = part; n < w.samples; n += motion_parts)
        if (layer_of(layer_middle_depth(sample_of(w, n)), cuts) == float(layer)) {
            atomicMin(first_sample[layer], uint(n));
            break;
        }
    barrier();
    gnomon_layer_motion_sums sums = layer_motion_begin(sample_of(w, min(int(first_sample[layer]), none - 1)));
    for (int m = part; m < w.samples; m += motion_parts) {
        stochastic_sample s = sample_of(w, m);
        float middle = layer_middle_depth(s);
        if (layer_of(middle, cuts) == float(layer)) sums = layer_motion_add(sums, s, middle);
    }
    motions[i] = sums;
    barrier();
    if (part == 0 && layer < int(tile.layers)) {
        for (int k = 1; k < motion_parts; ++k) {
            gnomon_layer_motion_sums other = motions[int(i) + k];
            sums.x = sums.x + other.x;
            sums.y = sums.y + other.y;
            sums.z = sums.z + other.z;
            sums.square = sums.square + other.square;
            sums.square_z = sums.square_z + other.square_z;
            sums.count = sums.count + other.count;
            sums.least = min(sums.least, other.least);
            sums.greatest = max(sums.greatest, other.greatest);
            sums.least_d = min(sums.least_d, other.least_d);
            sums.greatest_d = max(sums.greatest_d, other.greatest_d);
        }
        layer_grid grid = layer_grid_make(layer_motion_end(sums), float(layer_guard), float(layer_side));
        tile_grids[layer] = grid;
        grids[begin + uint(layer)] = grid;
    }
    barrier();
}

// Part of the line at place along an axis that is from low to high, as distances along the line.
vec2 clipped(vec2 ends, float axis, float place, float low, float high)
{
    if (abs(axis) < 1e-6) return low <= place && place <= high ? ends : vec2(ends.x, ends.x);
    float a = (low - place) / axis, b = (high - place) / axis;
    return vec2(max(ends.x, min(a, b)), min(ends.y, max(a, b)));
}

// The inverse of the share of the shutter interval in which the samples of texel (u, v) are in the window, at most 8.
float evening_factor(layer_grid g, tile_window w, int u, int v)
{
    float reach = 0.5 * (g.motion + 1.0 / g.scale_u), across = (float(v) + 0.5 - g.middle) / g.scale_v;
    vec2 ends = vec2(-1e30, 1e30);
    ends = clipped(ends, g.axis_x, -g.axis_y * across, float(w.x0) - w.x, float(w.x1) - w.x);
    ends = clipped(ends, g.axis_y, g.axis_x * across, float(w.y0) - w.y, float(w.y1) - w.y);
    float along = (float(u) + 0.5 - g.middle) / g.scale_u;
    float seen = min(ends.y, along + reach) - max(ends.x, along - reach);
    return 1.0 / max(seen / (2.0 * reach), 0.125);
}

layer_sums scaled(layer_sums s, float factor)
{
    s.z = s.z * factor;
    s.zz = s.zz * factor;
    s.opacity = s.opacity * factor;
    s.weight = s.weight * factor;
    return s;
}

layer_sums plus(layer_sums a, layer_sums b)
{
    a.z = a.z + b.z;
    a.zz = a.zz + b.zz;
    a.opacity = a.opacity + b.opacity;
    a.weight = a.weight + b.weight;
    return a;
}

// The sums of the shared texels in this column, by a tent across the motion.
layer_sums blurred(int u, int v, float radius)
{
    int reach = min(int(radius), layer_side - 1);
    float total = layer_tent_weight(0.0, radius);
    for (int k = 1; k <= reach; ++k) total = total + 2.0 * layer_tent_weight(float(k), radius);
    layer_sums sums = no_sums();
    for (int from = max(v - reach, 0); from <= min(v + reach, layer_side - 1); ++from)
        sums = plus(sums, scaled(texels[from * layer_side + u],
                                 layer_tent_weight(abs(float(v - from)), radius) / total));
    return sums;
}

// The sums of each invocation's texel over all samples of the window, a batch after the other.
layer_sums accumulated(tile_window w, gnomon_layer_cuts cuts, layer_grid grid, int layer, uint i)
{
    layer_sums sums = no_sums();
    for (int begin = 0; begin < w.samples; begin += batch) {
        int count = min(batch, w.samples - begin);
        for (int n = int(i); n < count; n += invocations) {
            stochastic_sample s = sample_of(w, begin + n);
            gnomon_layer_place place = layer_grid_place(grid, s.x - w.x, s.y - w.y, s.t);
            gnomon_layer_share share = layer_share_of(layer_of(layer_middle_depth(s), cuts), float(layer));
            bool counts = layer_place_is_inside(grid, place) > 0.0 && share.weight > 0.0;
            texel_of[n] = counts ? int(place.v) * layer_side + int(place.u) : -1;
            depth_of[n] = layer_grid_own_depth(grid, s.z, s.t);
            opacity_of[n] = share.opacity;
        }
        barrier();
        if (int(i) < layer_side) { // a list of the samples in each row of texels, in their order
            int after = -1;
            for (int k = count - 1; k >= 0; --k)
                if (texel_of[k] >> 3 == int(i)) {
                    next_in_row[k] = after;
                    after = k;
                }
            first_in_row[i] = after;
        }
        barrier();
        for (int k = first_in_row[int(i) / layer_side]; k >= 0; k = next_in_row[k])
            if (texel_of[k] == int(i)) {
                gnomon_layer_share share;
                share.opacity = opacity_of[k];
                share.weight = 1.0;
                sums = layer_sums_add(sums, depth_of[k], share);
            }
        barrier();
    }
    return sums;
}

// Sums that are not known are no information.
layer_sums known(layer_sums s)
{
    float size = abs(s.z) + abs(s.zz) + abs(s.opacity) + abs(s.weight);
    if (size <= 1e30) return s;
    return no_sums();
}

// The mean of four texels of a level whose extent along a side is given.
layer_sums mean_of_four(int begin, int extent, int u, int v)
{
    layer_sums sums = no_sums();
    for (int k = 0; k < 4; ++k)
        sums = plus(sums, scaled(texels[begin + (2 * v + k / 2) * extent + 2 * u + k % 2], 0.25));
    return sums;
}

void accumulate_tile(uint tile_number, uint i)
{
    tile_layers tile = tiles[tile_number];
    uint begin = first[tile_number];
    if (first[tile_number + 1] == begin) return;
    tile_window w = window_around(tile_number);
    find_grids(w, tile, begin, i);
    int u = int(i) % layer_side, v = int(i) / layer_side;
    for (int layer = 0; layer < int(tile.layers); ++layer) {
        layer_grid grid = tile_grids[layer];
        layer_sums sums = accumulated(w, cuts_of(tile), grid, layer, i);
        texels[i] = scaled(sums, evening_factor(grid, w, u, v));
        barrier();
        float radius = layer_tent_radius(grid, float(layer_guard), float(layer_tile));
        if (radius > 1.0) sums = blurred(u, v, radius);
        else sums = texels[i];
        barrier();
        texels[i] = known(sums);
        barrier();
        int from = 0;
        for (int extent = layer_side / 2; extent > 0; extent /= 2) {
            int to = from + 4 * extent * extent;
            if (int(i) < extent * extent)
                texels[to + int(i)] = mean_of_four(from, 2 * extent, int(i) % extent, int(i) / extent);
            barrier();
            from = to;
        }
        uint place = (begin + uint(layer)) * uint(texels_of_layer);
        for (int k = int(i); k < texels_of_layer; k += invocations) layer_texels[place + uint(k)] = texels[k];
        barrier();
    }
}
