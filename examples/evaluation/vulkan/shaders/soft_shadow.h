// A soft shadow from a summed-area table, in the words that GLSL and HLSL share once vec4, uvec4 and table_texel are known:
// blockers from four texels of the search region, intensity from sixteen of the filter region, which is interpolated.

struct soft_settings {
    vec2 per_depth;                    // width of the penumbra in texels per unit of signed depth
    float widest;                      // search, in texels along each axis
    float most_texels, scale;          // of the table
    float darkening, size;             // strength; texels of the map along a side
};

// The sum of all texels above and left of a corner of the grid.
uvec4 prefix(float x, float y)
{
    if (x < 1 || y < 1) return uvec4(0, 0, 0, 0);
    return table_texel(int(x) - 1, int(y) - 1);
}

channels4 channels_of(vec4 sums, float area, float scale)
{
    channels4 c;
    c.c1 = sums.x;
    c.c2 = sums.y;
    c.c3 = sums.z;
    c.c4 = sums.w;
    return moments4_summed_channels(c, area, scale);
}

channels4 grid_mean(summed_area_rectangle place, float scale)
{
    summed_area_rectangle r = summed_area_grow(place);
    uvec4 s = prefix(r.x1, r.y1) - prefix(r.x0, r.y1) - prefix(r.x1, r.y0) + prefix(r.x0, r.y0);
    return channels_of(vec4(s), (r.x1 - r.x0) * (r.y1 - r.y0), scale);
}

// The sums over the three rectangles between two rows of corners, weighted by their widths.
vec4 row_sum(uvec4 upper[4], uvec4 lower[4], summed_area_parts x)
{
    return x.width0 * vec4(lower[1] - lower[0] - upper[1] + upper[0]) +
           x.width1 * vec4(lower[2] - lower[1] - upper[2] + upper[1]) +
           x.width2 * vec4(lower[3] - lower[2] - upper[3] + upper[2]);
}

channels4 interpolated_mean(summed_area_rectangle r, float scale)
{
    summed_area_parts x = summed_area_split(r.x0, r.x1);
    summed_area_parts y = summed_area_split(r.y0, r.y1);
    float columns[4] = {x.line0, x.line1, x.line2, x.line3};
    float rows[4] = {y.line0, y.line1, y.line2, y.line3};
    float heights[3] = {y.width0, y.width1, y.width2};
    uvec4 upper[4], lower[4];
    vec4 sums = vec4(0, 0, 0, 0);
    for (int i = 0; i < 4; ++i) upper[i] = prefix(columns[i], rows[0]);
    for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 4; ++i) lower[i] = prefix(columns[i], rows[j + 1]);
        sums += heights[j] * row_sum(upper, lower, x);
        upper = lower;
    }
    return channels_of(sums, summed_area_width(x) * summed_area_width(y), scale);
}

summed_area_rectangle region_of(vec2 place, float width_x, float width_y, soft_settings s)
{
    return summed_area_clip(summed_area_around(place.x, place.y, width_x, width_y), s.size, s.size, s.most_texels);
}

// Shadow intensity at a place of the map in texels, at depth z, with this gradient of depth on the receiver's plane. Bias is
// the most that the plane rises up to the outermost texel of the filter.
float soft_intensity(vec2 place, float z, depth_gradient gradient, soft_settings s)
{
    float search_x = penumbra_directional(z, -1, s.per_depth.x, s.widest);
    float search_y = penumbra_directional(z, -1, s.per_depth.y, s.widest);
    channels4 searched = grid_mean(region_of(place, search_x, search_y, s), s.scale);
    hankel4 h = hankel4_from_summed(searched, s.most_texels);
    if (s.darkening < hamburger4_lower(h, z)) return 1; // umbra
    float z_b = blocker4_depth(h, z);
    float x = penumbra_directional(z, z_b, s.per_depth.x, s.widest);
    float y = penumbra_directional(z, z_b, s.per_depth.y, s.widest);
    channels4 filtered = interpolated_mean(region_of(place, x, y, s), s.scale);
    float bias = depth_bias_receiver_plane(gradient, 0.5 * x + 1, 0.5 * y + 1, 2);
    return over_darken(moments4_summed_intensity(filtered, s.most_texels, z - bias), s.darkening);
}
