// Texels of a rectified map, in the words that GLSL and HLSL share once vec2 is known, with a rectified_view named seen.
#include "rectified_row.h"

float radius_of(int column) { return (float(column) + 0.5) * seen.texel.x; }

// The place in the shadow map of the light ray at a radius, in texels.
vec2 place_of(rectified_row row, float radius)
{
    return vec2(seen.eye.x + radius * (row.cosine * seen.light.x), seen.eye.y + radius * (row.sine * seen.light.y));
}

bool within_map(vec2 place)
{
    return place.x >= 0 && place.y >= 0 && place.x < seen.eye.w && place.y < seen.eye.w;
}

rectified_range range_of(rectified_row row)
{
    rectified_range range;
    range.middle = row.middle;
    range.scale = row.scale;
    return range;
}

// The depth in the row's range of an occluder at a radius, from its signed depth in the shadow map. What lies at the far plane
// shadows nothing.
float occluder_depth(rectified_row row, float radius, float depth, float far_plane)
{
    float z = (max(depth, -1.0) - seen.eye.z) * seen.light.z;
    float mapped = seen.light.w > 0 ? rectified_cosine_depth(rectified_cosine(radius, 0, z), range_of(row))
                                    : rectified_polar_depth(polynomial_atan2(radius, z), range_of(row));
    return depth < far_plane && mapped <= 1 ? mapped : 1.0;
}

// The level of the shadow map whose texels are as wide as the texel of the rectified map at a radius.
float shadow_level(float radius)
{
    float texels = max(abs(seen.light.x), abs(seen.light.y));
    return rectified_level(rectified_footprint(radius, seen.texel.x, seen.texel.y, texels));
}

// The distribution of two depths for a sample of a map of four moments in 16-bit UNORM.
gnomon_distribution2 two_depths(vec4 t)
{
    const float rounding = 0.00000762939453125; // of a channel, 2^-17
    channels4 c;
    c.c1 = t.x;
    c.c2 = t.y;
    c.c3 = t.z;
    c.c4 = t.w;
    moments4 b = theta4_inverse(c);
    return two_point_distribution(b.b1, b.b2, two_point_third_moment(b.b1, b.b2, b.b3, rounding),
                                  two_point_unorm16_least_variance);
}

// The depth in the row's range of a view ray of this polar angle.
float ray_depth(rectified_row row, float polar)
{
    return seen.light.w > 0 ? rectified_cosine_depth(polynomial_cos(polar), range_of(row))
                            : rectified_polar_depth(polar, range_of(row));
}

// The level of prefix averages for a ray that ends at a radius, whose pixel has this extent there: averages over the rows of the
// pixel, but over no more columns than the ray crosses.
float level_of(float radius, float footprint)
{
    return rectified_level(min(footprint / (radius * seen.texel.y), radius / seen.texel.x));
}

// The coordinate of a linear sampler along a row of prefix averages, in a level of so many columns, for the position in columns
// of the map: between two texels the exact weight of the ray's end (passes/rectified_look_up.hpp).
float sampled_column(float position, float columns, float optical_depth)
{
    float wide = seen.texel.z / columns;
    float x = clamp(position / wide - 0.5, 0.0, columns - 1);
    float lower = floor(x);
    float share = transmittance_weight_between((lower + 0.5) * wide + 0.5, wide, x - lower, optical_depth);
    return (lower + 0.5 + share) / columns;
}

// The rows on either side of a position across them, and the fraction from one to the other. The last row is next to the first
// in a full turn.
struct row_pair {
    int lower, upper;
    float fraction;
};

row_pair row_pair_of(float position)
{
    int count = int(seen.texel.w);
    bool wraps = seen.frame.w > 0;
    float x = position - 0.5;
    if (!wraps) x = clamp(x, 0.0, float(count - 1));
    int lower = int(floor(x));
    row_pair r;
    r.fraction = x - floor(x);
    r.lower = (lower + count) % count;
    r.upper = wraps ? (lower + 1) % count : min(lower + 1, count - 1);
    return r;
}

// The distance along the camera's axis, from what the depth buffer has.
float view_distance(float depth)
{
    return seen.planes.x * seen.planes.y / (seen.planes.y - depth * (seen.planes.y - seen.planes.x));
}
