// The shadow intensity of a receiver in a layered map (Andersson et al. 2015, Sec. 4.2 and 5), in the words that GLSL and HLSL
// share, in the steps of the CPU's pass: the product of visibilities through the layers of its tile, each from sums over the
// probes of its footprint, at a level between two mips, or at the first one above at which there is any weight.

// As of passes/layers/layer_look_up.hpp.
struct layer_receiver {
    float x, y, z, t, x0, y0, t0, x1, y1, t1, cross_x, cross_y, slope, random_x, random_y;
};

// Two texels of a line of `extent`, and the fraction from one to the other. Between those beyond its ends there are none.
struct texel_pair {
    int lower, upper;
    float fraction;
};

texel_pair pair_of(float coordinate, int extent, int margin)
{
    float least = float(-margin), most = float(extent - 1 + margin);
    float x = coordinate > least ? (coordinate < most ? coordinate : most) : least;
    texel_pair r;
    r.lower = int(floor(x));
    r.fraction = x - floor(x);
    r.upper = r.fraction > 0.0 ? r.lower + 1 : r.lower;
    return r;
}

// A layer, or the plain map with the place of a tile's window on it.
struct texel_source {
    bool is_plain;
    int begin; // of the layer's texels
    float x, y;
    int levels;
};

// The place of a texel in its array, or -1 where the plain map has none.
int place_of(texel_source from, int level, int x, int y)
{
    if (!from.is_plain) {
        int side = layer_side >> level;
        return from.begin + (layer_side * layer_side - side * side) / 3 * 4 + y * side + x;
    }
    int extent = int(given.width) >> level, side = layer_block >> level;
    if (x < 0 || y < 0 || x >= extent || y >= extent) return -1;
    if (blocks[y / side * (int(given.width) / layer_block) + x / side] == 0) return -1;
    int begin = 0;
    for (int l = 0; l < level; ++l) begin += (int(given.width) >> l) * (int(given.width) >> l);
    return begin + y * extent + x;
}

layer_sums add_bilinear(layer_sums sums, texel_source from, float weight, gnomon_layer_place at, int level)
{
    float scale = 1.0 / float(1 << level);
    int extent = (from.is_plain ? int(given.width) : layer_side) >> level, margin = from.is_plain ? 1 : 0;
    texel_pair nx = pair_of((from.x + at.u) * scale - 0.5, extent, margin);
    texel_pair ny = pair_of((from.y + at.v) * scale - 0.5, extent, margin);
    float upper = weight * ny.fraction, lower = weight - upper;
    for (int k = 0; k < 4; ++k) {
        int place = place_of(from, level, k % 2 == 0 ? nx.lower : nx.upper, k / 2 == 0 ? ny.lower : ny.upper);
        float part = (k / 2 == 0 ? lower : upper) * (k % 2 == 0 ? 1.0 - nx.fraction : nx.fraction);
        if (place < 0) continue;
        layer_sums c;
        if (from.is_plain) c = plain[place];
        else c = layer_texels[place];
        sums.z = sums.z + part * c.z;
        sums.zz = sums.zz + part * c.zz;
        sums.opacity = sums.opacity + part * c.opacity;
        sums.weight = sums.weight + part * c.weight;
    }
    return sums;
}

layer_sums sums_over(gnomon_layer_footprint footprint, texel_source from)
{
    layer_sums sums;
    sums.z = 0.0;
    sums.zz = 0.0;
    sums.opacity = 0.0;
    sums.weight = 0.0;
    texel_pair between = pair_of(footprint.level, from.levels, 0);
    int level = between.lower;
    float weight = 1.0 - between.fraction;
    for (bool more = true; more;) {
        for (float k = 0.0; k < footprint.probes; k += 1.0)
            sums = add_bilinear(sums, from, weight, layer_probe(footprint, k), level);
        more = level < between.upper || (!(sums.weight > 0.0) && level < from.levels - 1);
        weight = level < between.upper ? between.fraction : 1.0;
        ++level;
    }
    return sums;
}

// The layer's own depth of a receiver, less a bias that covers `reach` texels of the layer.
float biased_depth(layer_grid grid, layer_receiver r, float reach)
{
    float bias = layer_bias(grid, r.slope, r.slope, r.t, reach, given.limit);
    float rounding = max(given.rounding, 0.0625 * given.rounding * abs(grid.d_z));
    return layer_grid_own_depth(grid, r.z - (bias + rounding), r.t);
}

// Visibility through one layer of a tile with this centre.
float visibility_through(layer_grid grid, texel_source from, float x, float y, layer_receiver r)
{
    grid.spread = 0.0;
    grid.spread_z = 0.0;
    if (!(biased_depth(grid, r, given.reach) > -1.0)) return 1.0; // before all of it
    gnomon_layer_footprint footprint = layer_footprint_make(grid, r.x0 - x, r.y0 - y, r.t0, r.x1 - x, r.y1 - y, r.t1,
                                                            r.cross_x, r.cross_y, layer_widening(grid, r.t));
    gnomon_layer_place place = layer_grid_place(grid, r.x - x, r.y - y, r.t);
    float off_u = abs(place.u - footprint.u), off_v = abs(place.v - footprint.v);
    if (!(off_u + off_v >= 0.0)) return 1.0; // a place of NaN
    float z = biased_depth(grid, r, given.reach + max(off_u, off_v));
    if (!(z > -1.0)) return 1.0;
    float least = max(layer_minimum_variance(grid, r.slope, 0.0), given.least_variance);
    return layer_visibility(sums_over(footprint, from), z, least);
}

// The grid by which a receiver sees the plain map.
layer_grid plain_grid()
{
    gnomon_layer_motion still;
    still.d_x = 0.0;
    still.d_y = 0.0;
    still.d_z = 0.0;
    still.spread = 0.0;
    still.spread_z = 0.0;
    still.least = -1.0;
    still.greatest = 1.0;
    return layer_grid_make(still, float(layer_guard), float(layer_guard));
}

float visibility_in(int column, int row, layer_receiver r)
{
    float x = (float(column) + 0.5) * float(layer_tile), y = (float(row) + 0.5) * float(layer_tile);
    uint tile = uint(row * (int(given.width) / layer_tile) + column);
    uint begin = first[tile], end = first[tile + 1];
    bool plain_tile = begin == end;
    if (plain_tile) end = begin + 1;
    float visibility = 1.0;
    for (uint n = begin; n < end && visibility > 0.0; ++n) {
        texel_source from;
        from.is_plain = plain_tile;
        from.begin = int(n) * 85;
        from.x = 0.0;
        from.y = 0.0;
        from.levels = 4;
        layer_grid grid;
        if (plain_tile) {
            grid = plain_grid();
            from.x = x - grid.middle;
            from.y = y - grid.middle;
            from.levels = 3;
        } else grid = grids[n];
        visibility = visibility * visibility_through(grid, from, x, y, r);
    }
    return visibility;
}

float layer_intensity(layer_receiver r)
{
    float size = float(given.width), tile = float(layer_tile);
    if (!(0.0 <= r.x && r.x < size && 0.0 <= r.y && r.y < size)) return 0.0;
    int count = int(given.width) / layer_tile;
    int column = min(int(r.x / tile), count - 1), row = min(int(r.y / tile), count - 1);
    gnomon_layer_neighbour nx = layer_neighbour_at(r.x - (float(column) + 0.5) * tile, tile);
    gnomon_layer_neighbour ny = layer_neighbour_at(r.y - (float(row) + 0.5) * tile, tile);
    int beside = column + int(nx.towards), beyond = row + int(ny.towards);
    if (beside < 0 || beside >= count) {
        beside = column;
        nx.weight = 0.0;
    }
    if (beyond < 0 || beyond >= count) {
        beyond = row;
        ny.weight = 0.0;
    }
    // A look-up in this tile or in a neighbour, or one in each of four.
    bool chosen_x = given.tiles == 1 && r.random_x < nx.weight, chosen_y = given.tiles == 1 && r.random_y < ny.weight;
    float shadow = 0.0;
    for (int k = 0; k < (given.tiles == 2 ? 4 : 1); ++k) {
        bool is_beside = k % 2 == 1 || chosen_x, is_beyond = k / 2 == 1 || chosen_y;
        float weight = 1.0;
        if (given.tiles == 2)
            weight = (is_beside ? nx.weight : 1.0 - nx.weight) * (is_beyond ? ny.weight : 1.0 - ny.weight);
        if (weight > 0.0)
            shadow = shadow +
                     weight * (1.0 - visibility_in(is_beside ? beside : column, is_beyond ? beyond : row, r));
    }
    return saturate_or_zero(shadow);
}
