// Clusters of depths around a tile by one workgroup (Andersson et al. 2015, Sec. 4.1), in the words that GLSL and HLSL share: the
// window's depths by a reduction, its bins as bits that all invocations set, and the fold over bins by one of them. Blocks of the
// plain map that a plain tile looks up are marked.
void cluster_tile(uint tile, uint i)
{
    tile_window w = window_around(tile);
    gnomon_layer_window depths = layer_window_begin(4.0); // of the background, none
    uint moves = 0;
    for (int n = int(i); n < w.samples; n += int(invocations)) {
        stochastic_sample s = sample_of(w, n);
        depths = layer_window_add(depths, layer_middle_depth(s));
        if (!(s.d_x == 0 && s.d_y == 0 && s.d_z == 0)) moves = 1;
    }
    least[i] = depths.least;
    greatest[i] = depths.greatest;
    if (i == 0) {
        any_moves = 0;
        bins[0] = 0;
        bins[1] = 0;
    }
    barrier();
    for (uint step = invocations / 2; step > 0; step /= 2) {
        if (i < step) {
            least[i] = min(least[i], least[i + step]);
            greatest[i] = max(greatest[i], greatest[i + step]);
        }
        barrier();
    }
    depths.least = least[0];
    depths.greatest = greatest[0];
    if (moves == 1) atomicOr(any_moves, 1u);
    for (int k = int(i); k < w.samples; k += int(invocations)) {
        int bin = int(layer_bin_of(layer_middle_depth(sample_of(w, k)), depths));
        if (bin >= 0) atomicOr(bins[bin / 32], 1u << uint(bin % 32));
    }
    barrier();
    if (i > 0) return;
    gnomon_layer_runs runs = layer_cuts_begin(depths);
    for (int b = 0; b < 64; ++b) runs = layer_cuts_add(runs, float(bins[b / 32] >> uint(b % 32) & 1u));
    gnomon_layer_cuts cuts = layer_cuts_end(runs, 4.0);
    tile_layers found;
    found.c0 = cuts.c0;
    found.c1 = cuts.c1;
    found.c2 = cuts.c2;
    found.moves = any_moves;
    found.layers = 0;
    if (depths.least <= depths.greatest)
        found.layers = 1u + uint(cuts.c0 < 3.0) + uint(cuts.c1 < 3.0) + uint(cuts.c2 < 3.0); // 3 is no cut
    tiles[tile] = found;
    first[tile] = is_plain(found) ? 0 : found.layers;
    if (!is_plain(found)) return;
    int across = int(given.width) / layer_block;
    for (int y = w.y0 / layer_block; y <= (w.y1 - 1) / layer_block; ++y)
        for (int x = w.x0 / layer_block; x <= (w.x1 - 1) / layer_block; ++x) blocks[y * across + x] = 1;
}
