// The ranges of one texel, in the words that GLSL and HLSL share, with the buffers records, first, ranges, and tolerance and
// fills: times at which each triangle covers the texel, and its depth, by the kernels and in the order of the rasterizer on the
// CPU. Functions return the place after the last range. They write ranges where fills is 1, and count them elsewhere.

// Edge functions at a place in the tile, for one facing. Those of linear triangles have the mean as their middle coefficient.
gnomon_moving_edges edges_of(tile_record r, float facing, float x, float y)
{
    triangle_setup setup = r.equations;
    if (facing < 0) {
        setup.a = edge_equation_widen(setup.a, r.margin_a, -2.0);
        setup.b = edge_equation_widen(setup.b, r.margin_b, -2.0);
        setup.c = edge_equation_widen(setup.c, r.margin_c, -2.0);
    }
    gnomon_moving_edges e = triangle_setup_edges(setup, x, y);
    if ((r.bits & depth_linear) != 0) {
        e.a.e1 = 0.5 * (e.a.e0 + e.a.e2);
        e.b.e1 = 0.5 * (e.b.e0 + e.b.e2);
        e.c.e1 = 0.5 * (e.c.e0 + e.c.e2);
    }
    return e;
}

// Depth over time. The edges are widened, so their sum exceeds the true one by the sum of the margins.
depth_curve curve_of(tile_record r, gnomon_moving_edges e, float facing, float x, float y)
{
    depth_curve c = moving_depth_curve(r.depths, e, x, y);
    float excess = facing * (r.margin_a + r.margin_b + r.margin_c);
    c.d0 = c.d0 - excess;
    c.d1 = c.d1 - (excess + excess);
    c.d2 = c.d2 - excess;
    return c;
}

gnomon_edge_intervals inside_edge(gnomon_moving_edge e, float facing, bool is_linear)
{
    if (!is_linear) return moving_edge_inside(e, facing);
    gnomon_linear_interval times = linear_edge_inside(facing * e.e0, facing * e.e2);
    gnomon_edge_intervals x;
    x.begin = times.begin;
    x.end = times.end;
    x.gap_begin = 2.0;
    x.gap_end = 2.0;
    return x;
}

uint add_range(uint at, float t0, float t1, float z0, float z1, float id)
{
    if (fills == 1) {
        depth_time_range r;
        r.t0 = t0;
        r.t1 = t1;
        r.z0 = z0;
        r.z1 = z1;
        r.id = id;
        ranges[at] = r;
    }
    return at + 1;
}

// One range where depth keeps to a line, several where it bends.
uint add_interval(uint at, depth_curve c, bool is_linear, float begin, float end, float id)
{
    depth_line l;
    if (is_linear) l = linear_depth_line(c, begin, end);
    else l = depth_curve_line(c, begin, end);
    if (!(tolerance < l.deviation)) return add_range(at, begin, end, l.z0, l.z1, id);
    for (float passed = 0.0; passed < 1.0;) {
        depth_piece p = depth_curve_piece(c, begin, end, passed, tolerance);
        if (p.t0 < p.t1) at = add_range(at, p.t0, p.t1, p.z0, p.z1, id);
        passed = p.passed;
    }
    return at;
}

uint add_triangle(uint at, tile_record r, float x, float y)
{
    for (int side = 0; side < 2; ++side) {
        if ((r.bits & (side == 0 ? side_positive : side_negative)) == 0) continue;
        float facing = side == 0 ? 1.0 : -1.0;
        bool is_linear = (r.bits & depth_linear) != 0;
        gnomon_moving_edges e = edges_of(r, facing, x, y);
        coverage_intervals times = intersect_edge_intervals(inside_edge(e.a, facing, (r.bits & edge_a_linear) != 0),
                                                            inside_edge(e.b, facing, (r.bits & edge_b_linear) != 0),
                                                            inside_edge(e.c, facing, (r.bits & edge_c_linear) != 0));
        depth_curve c = curve_of(r, e, facing, x, y);
        for (int k = 0; k < int(times.count); ++k) {
            float begin = k == 0 ? times.begin0 : k == 1 ? times.begin1 : k == 2 ? times.begin2 : times.begin3;
            float end = k == 0 ? times.end0 : k == 1 ? times.end1 : k == 2 ? times.end2 : times.end3;
            at = add_interval(at, c, is_linear, begin, end, r.number);
        }
    }
    return at;
}

// Texels are in the order of range_map: tiles of 32 x 32, blocks of 4 x 4 in a tile. Returns the place after the last range.
uint add_texel(uint at, uint texel, uint begin, uint end)
{
    uint block = texel / 16 % 64, inside = texel % 16;
    float x = float(block % 8 * 4 + inside % 4) - 15.5, y = float(block / 8 * 4 + inside / 4) - 15.5;
    for (uint m = begin; m < end; ++m) at = add_triangle(at, records[members[m]], x, y);
    return at;
}
