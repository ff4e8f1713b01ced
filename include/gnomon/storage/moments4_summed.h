// Four moments in a summed-area table (soft/summed_area.h): from a depth to the codes of a texel, and from the mean
// channels of a rectangle to a shadow and to the depth of blockers.
//
//   a texel:        c = moments4_summed_encode(z)               channels of theta4; a resolve averages them
//                   codes = moments4_summed_codes(c, scale)     whole numbers, to be converted to 32-bit unsigned integers
//   a rectangle:    c = moments4_summed_channels(sums, area, scale)
//                   z_b = moments4_summed_blocker(c, most_texels, z_f)
//                   shadow = moments4_summed_intensity(c, most_texels, z_f - bias)
//
// Encoding and the inverse of theta4 keep the digits that Real has no room for: without them the noise of channels
// (summed_area_noise) would be twice as large. Intensities exceed Z(z < z_f), for every distribution Z on [-1, 1], by at
// most
//   moments4_summed_intensity   stored4_arithmetic_weight: certificates (certified4.h)
//   hankel4_from_summed         moments4_summed_bias_ratio times the noise, and that of arithmetic
// Tests search for the largest excess by hill climbing (tests/soft/honest_summed.cpp).
#ifndef GNOMON_STORAGE_MOMENTS4_SUMMED_H
#define GNOMON_STORAGE_MOMENTS4_SUMMED_H
#include "../soft/blocker.h"
#include "../soft/summed_area.h"
#include "moments4.h"
GNOMON_NAMESPACE_BEGIN

GNOMON_CONSTANT(moments4_summed_bias_ratio, 5.0);
GNOMON_CONSTANT(moments4_summed_node_ratio, 4.0); // for the nodes of certificates

/// a + b as a double word, for magnitudes in any order.
GNOMON_DETAIL_KERNEL GNOMON_T(double_word) summed_two_sum(Real a, Real b) { return two_difference(a, Real(-1) * b); }

GNOMON_CONSTANT(summed_four_ninths, 0.44444444444444442);
GNOMON_CONSTANT(summed_third, 0.33333333333333331);

/// The digits of a root for which Real has no room: root - factor, where factor is the rounded root and root^2 = square.
GNOMON_DETAIL_KERNEL Real summed_root_rest(Real factor, Real square)
{
    double_word p = two_product(factor, factor);
    return ((square - p.high) - p.low) * (Real(0.5) / factor);
}

/// The four channels of the texel of a depth z, each in [0, 1].
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane, which shadows nothing.
/// Error: of a channel, 0.51 2^-p.
/// Source: Peters 2017, Eq. 3
GNOMON_KERNEL GNOMON_T(channels4) moments4_summed_encode(Real z)
{
    Real x = clamp_or_high(z, Real(-1), Real(1));
    double_word z2 = two_product(x, x);
    double_word z3 = two_product(z2.high, x);
    z3.low = z3.low + z2.low * x;
    double_word z4 = two_product(z2.high, z2.high);
    z4.low = z4.low + Real(2) * (z2.high * z2.low);
    GNOMON_T(channels4) c;
    // 1/2 + 3/2 z - 2 z^3
    double_word s = two_difference(Real(0.5), Real(2) * z3.high);
    double_word t = summed_two_sum(s.high, x);
    double_word u = summed_two_sum(t.high, Real(0.5) * x);
    c.c1 = u.high + (u.low + (t.low + (s.low - Real(2) * z3.low)));
    // 4 (z^2 - z^4)
    double_word d = two_difference(z2.high, z4.high);
    c.c2 = Real(4) * (d.high + (d.low + (z2.low - z4.low)));
    // 1/2 + sqrt(3)/2 (z - 4/9 z^3)
    Real ninths = GNOMON_LITERAL(summed_four_ninths);
    double_word n = two_product(ninths, Real(9));
    double_word q = two_product(z3.high, ninths);
    double_word w = two_difference(x, q.high);
    Real rest = w.low - (q.low + (z3.low * ninths + z3.high * (((Real(4) - n.high) - n.low) * (Real(0.25) * ninths))));
    Real root = GNOMON_LITERAL(theta4_31);
    double_word p = two_product(root, w.high);
    double_word h = summed_two_sum(Real(0.5), p.high);
    c.c3 = h.high + (h.low + (p.low + (root * rest + summed_root_rest(root, Real(0.75)) * w.high)));
    // (z^2 + z^4) / 2
    double_word m = summed_two_sum(z2.high, z4.high);
    c.c4 = Real(0.5) * (m.high + (m.low + (z2.low + z4.low)));
    return c;
}

/// The codes of a texel with these channels: whole numbers in [0, 2^32 - 1].
/// Domain: any channels, each limited to [0, 1]; scale by summed_area_scale.
/// NaN: the codes of the far plane.
GNOMON_KERNEL GNOMON_T(channels4) moments4_summed_codes(GNOMON_T(channels4) c, GNOMON_SETTING scale)
{
    Real any = (clamp_or_nan(c.c1, Real(0), Real(1)) + clamp_or_nan(c.c2, Real(0), Real(1))) +
               (clamp_or_nan(c.c3, Real(0), Real(1)) + clamp_or_nan(c.c4, Real(0), Real(1)));
    GNOMON_MASK known = any == any;
    channels4 border = moments4_summed_encode(Real(1));
    GNOMON_T(channels4) r;
    r.c1 = summed_area_code(gnomon_select(known, c.c1, border.c1), scale);
    r.c2 = summed_area_code(gnomon_select(known, c.c2, border.c2), scale);
    r.c3 = summed_area_code(gnomon_select(known, c.c3, border.c3), scale);
    r.c4 = summed_area_code(gnomon_select(known, c.c4, border.c4), scale);
    return r;
}

/// The mean channels of a rectangle, from the sums of its codes and its area.
/// Domain: sums and area as for summed_area_mean; the border, which is lit, for an area of 0.
/// NaN: channels of 0 for sums; the border for an area.
GNOMON_KERNEL GNOMON_T(channels4) moments4_summed_channels(GNOMON_T(channels4) sums, Real area, GNOMON_SETTING scale)
{
    GNOMON_MASK some = Real(0) < area;
    channels4 border = moments4_summed_encode(Real(1));
    GNOMON_T(channels4) r;
    r.c1 = gnomon_select(some, summed_area_mean(sums.c1, area, scale), border.c1);
    r.c2 = gnomon_select(some, summed_area_mean(sums.c2, area, scale), border.c2);
    r.c3 = gnomon_select(some, summed_area_mean(sums.c3, area, scale), border.c3);
    r.c4 = gnomon_select(some, summed_area_mean(sums.c4, area, scale), border.c4);
    return r;
}

/// The factored matrix of the channels of a rectangle, with a constant bias of weight alpha. What rounding would take from
/// the moments is added to their covariances.
GNOMON_DETAIL_KERNEL GNOMON_T(hankel4) hankel4_from_summed_theta(GNOMON_T(channels4) c, GNOMON_SETTING bias2,
                                                                 GNOMON_SETTING bias4, GNOMON_SETTING alpha)
{
    double_word c1 = two_difference(c.c1, Real(0.5));
    double_word c3 = two_difference(c.c3, Real(0.5));
    Real root = GNOMON_LITERAL(theta4_inverse13);
    Real third = GNOMON_LITERAL(summed_third);
    // t = sqrt(3) (c3 - 1/2),    b1 = t - (c1 - 1/2) / 3,    b3 = 3/4 (t - (c1 - 1/2))
    double_word t = two_product(root, c3.high);
    t.low = t.low + (root * c3.low + summed_root_rest(root, Real(3)) * c3.high);
    double_word n = two_product(third, Real(3));
    double_word q = two_product(third, c1.high);
    q.low = q.low + (third * c1.low + (third * ((Real(1) - n.high) - n.low)) * c1.high);
    double_word d1 = two_difference(t.high, q.high);
    double_word d3 = two_difference(t.high, c1.high);
    double_word p3 = two_product(Real(0.75), d3.high);
    Real eighth = Real(0.125) * c.c2;
    double_word d2 = summed_two_sum(c.c4, eighth);
    double_word d4 = two_difference(c.c4, eighth);
    GNOMON_T(moments4) b;
    b.b1 = d1.high;
    b.b2 = d2.high;
    b.b3 = p3.high;
    b.b4 = d4.high;
    GNOMON_T(moments4) e;
    e.b1 = (d1.low + (t.low - q.low)) - alpha * b.b1;
    e.b2 = d2.low + alpha * (bias2 - b.b2);
    e.b3 = (p3.low + Real(0.75) * (d3.low + (t.low - c1.low))) - alpha * b.b3;
    e.b4 = d4.low + alpha * (bias4 - b.b4);
    return hankel4_with_change(b, e);
}

/// The factored matrix of the channels of a rectangle, with the constant bias of a table for most_texels.
/// Domain: most_texels as of the table's scale.
/// NaN: stays NaN; a most_texels of NaN counts as a small one.
GNOMON_KERNEL GNOMON_T(hankel4) hankel4_from_summed(GNOMON_T(channels4) c, GNOMON_SETTING most_texels)
{
    Real weight = GNOMON_LITERAL(moments4_summed_bias_ratio) * summed_area_noise(most_texels);
    return hankel4_from_summed_theta(c, GNOMON_LITERAL(bias4_theta_b2), GNOMON_LITERAL(bias4_theta_b4),
                                     gnomon_min(weight, Real(0.5)));
}

/// Shadow intensity in [0, 1] at depth z_f from the channels of a rectangle.
/// Domain: any z_f, limited to [-1, 1]; most_texels as of the table's scale.
/// NaN: 0, lit.
GNOMON_KERNEL Real moments4_summed_intensity(GNOMON_T(channels4) c, GNOMON_SETTING most_texels, Real z_f)
{
    Real noise = summed_area_noise(most_texels);
    Real weight = gnomon_min(GNOMON_LITERAL(moments4_summed_node_ratio) * noise, Real(0.5));
    hankel4 h = hankel4_from_summed_theta(c, GNOMON_LITERAL(bias4_theta_b2), GNOMON_LITERAL(bias4_theta_b4), weight);
    return certified4_theta_constant_bias_lower(h, noise, GNOMON_LITERAL(bias4_theta_b2),
                                                GNOMON_LITERAL(bias4_theta_b4), weight, z_f);
}

/// Mean blocker depth in [-1, z_f] from the channels of a search rectangle.
/// Domain: z_f in [-1, 1], clamped.
/// NaN: no blocker, z_f, for a NaN in c; a z_f of NaN is the far plane.
GNOMON_KERNEL Real moments4_summed_blocker(GNOMON_T(channels4) c, GNOMON_SETTING most_texels, Real z_f)
{
    return blocker4_depth(hankel4_from_summed(c, most_texels), z_f);
}

GNOMON_NAMESPACE_END
#endif
