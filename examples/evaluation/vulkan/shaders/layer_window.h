// The window around a tile of the light's map, in the words that GLSL and HLSL share, with all_samples and given, the sizes.
struct tile_window {
    int x0, x1, y0, y1; // texels of the map
    float x, y;         // centre of the tile
    int samples;        // in the window
};

tile_window window_around(uint tile)
{
    int size = int(given.width), columns = size / layer_tile, margin = (layer_guard - layer_tile) / 2;
    int left = int(tile) % columns * layer_tile, top = int(tile) / columns * layer_tile;
    tile_window w;
    w.x0 = max(left - margin, 0);
    w.x1 = min(left + layer_tile + margin, size);
    w.y0 = max(top - margin, 0);
    w.y1 = min(top + layer_tile + margin, size);
    w.x = float(left) + 0.5 * float(layer_tile);
    w.y = float(top) + 0.5 * float(layer_tile);
    w.samples = (w.x1 - w.x0) * (w.y1 - w.y0) * int(given.samples);
    return w;
}

// Sample n of the window, row by row.
stochastic_sample sample_of(tile_window w, int n)
{
    int row = (w.x1 - w.x0) * int(given.samples);
    int texel = (w.y0 + n / row) * int(given.width) + w.x0;
    return all_samples[texel * int(given.samples) + n % row];
}

gnomon_layer_cuts cuts_of(tile_layers tile)
{
    gnomon_layer_cuts cuts;
    cuts.c0 = tile.c0;
    cuts.c1 = tile.c1;
    cuts.c2 = tile.c2;
    return cuts;
}

bool is_plain(tile_layers tile) { return tile.layers == 1 && tile.moves == 0; }
