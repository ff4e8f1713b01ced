// Shadow intensities of receivers in a map of resolved lists, in the words that GLSL and HLSL share, with the buffers first and
// ranges, and size, the texels along a side of the map: bilinear filtering, a box shutter, lit outside of the map.

// The number of a texel in the order of range_map: tiles of 32 x 32, blocks of 4 x 4 in a tile. Sizes are whole tiles.
uint texel_number(uint x, uint y)
{
    uint block = y % 32 / 4 * 8 + x % 32 / 4;
    return (y / 32 * (size / 32) + x / 32) * 1024 + block * 16 + y % 4 * 4 + x % 4;
}

bool in_map(float x, float y) { return x >= 0.0 && y >= 0.0 && x < float(size) && y < float(size); }

float static_intensity(receiver_path path)
{
    gnomon_texel_position at = receiver_path_at(path, path.depth.t0);
    float left = at.x - 0.5, top = at.y - 0.5, column = texel_below(left), row = texel_below(top);
    static_receiver state = static_receiver_begin(path.depth.z0, path.depth.id, path.depth.t0, path.depth.t1);
    for (int tap = 0; tap < 4; ++tap) {
        float i = float(tap % 2), j = float(tap / 2);
        if (!in_map(column + i, row + j)) continue;
        uint texel = texel_number(uint(column + i), uint(row + j));
        state = static_receiver_set_weight(state, texel_weight(left - column, i, 1.0) * texel_weight(top - row, j, 1.0));
        for (uint k = first[texel]; k < first[texel + 1]; ++k) {
            depth_time_range hidden = static_receiver_occluding_part(state, ranges[k]);
            float share0 = shutter_box(hidden.t0, state.begin, state.end);
            float share1 = shutter_box(hidden.t1, state.begin, state.end);
            state = static_receiver_add(state, receiver_lost_light(hidden, state.id, share0, share1));
        }
    }
    return static_receiver_end(state);
}

float moving_intensity(receiver_path path)
{
    texel_sweep sweep = texel_sweep_over(receiver_path_shift(path, -0.5, -0.5), -1.0, -1.0, float(size), float(size));
    moving_receiver state = moving_receiver_begin(path, path.depth.t0, path.depth.t1);
    for (bool more = sweep.t_begin < sweep.t_last; more;) {
        for (int tap = 0; tap < 4; ++tap) {
            float i = float(tap % 2), j = float(tap / 2);
            if (!in_map(sweep.column + i, sweep.row + j)) continue;
            uint texel = texel_number(uint(sweep.column + i), uint(sweep.row + j));
            state = moving_receiver_tap(state, sweep, i, j, 1.0);
            for (uint k = first[texel]; k < first[texel + 1]; ++k) {
                depth_time_range r = ranges[k];
                if (!(r.t0 < sweep.t_end && sweep.t_begin < r.t1)) continue;
                depth_time_range hidden = moving_receiver_occluding_part(state, r);
                state = moving_receiver_add(
                    state, moving_receiver_filtered_light(state, hidden, state.begin, state.end, 1.0, 0.0));
            }
        }
        more = sweep.t_end < sweep.t_last;
        sweep = texel_sweep_next(sweep);
    }
    return moving_receiver_end(state);
}
