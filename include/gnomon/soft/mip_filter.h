// Filters of any width from a mip chain, round ones in place of the boxes of summed-area tables: a cubic B-spline over the
// texels of a level, by four bilinear look-ups (Sigg & Hadwiger 2005), mixed between two levels.
//
// The texels of level l are means over boxes of s = 2^l texels of the map, so that the spline at that level has the variance
// (1/3 + 1/12) s^2 along each axis. A box of a width w has w^2 / 12. Levels below and above mix so that both variances are
// equal:
//     w^2 / 12 = 5/12 4^l (1 + 3 f),    level = l + f,    f in [0, 1)
// Weights are not negative and sum to 1, so filtered moments are moments.
#ifndef GNOMON_SOFT_MIP_FILTER_H
#define GNOMON_SOFT_MIP_FILTER_H
#include "../numerics/exp.h"
#include "../numerics/texel_filter.h"
GNOMON_NAMESPACE_BEGIN

GNOMON_CONSTANT(mip_filter_fifth, 0.2);
GNOMON_CONSTANT(mip_filter_per_octave, 0.72134752044448170); // 1 / ln 4
GNOMON_CONSTANT(mip_filter_third, 0.33333333333333333);
GNOMON_CONSTANT(mip_filter_sixth, 0.16666666666666667);

/// The level of a mip chain whose cubic B-spline has the variance of a box of this width in texels of the map; its fraction
/// is the share of the level above. At least 0, the level for widths up to sqrt 5.
/// Domain: any width, limited to [sqrt 5, 65536].
/// NaN: 0.
GNOMON_KERNEL Real mip_filter_level(Real width)
{
    Real w = gnomon_max(gnomon_min(GNOMON_LITERAL(texel_limit), width), Real(1));
    Real squares = gnomon_max(GNOMON_LITERAL(mip_filter_fifth) * (w * w), Real(1));
    Real whole = texel_below(polynomial_log(squares) * GNOMON_LITERAL(mip_filter_per_octave));
    Real power = gnomon_power_of_two(whole);
    Real share = (squares / (power * power) - Real(1)) * GNOMON_LITERAL(mip_filter_third);
    return whole + saturate_or_zero(share);
}

/// Two bilinear look-ups along one axis that make a cubic B-spline: at the distances first and second from the centre of
/// the texel, the second with a weight and the first with the rest. first is in [-1, 0], second in [1, 2].
GNOMON_STRUCT(mip_filter_taps) { Real first, second, weight; };

/// The look-ups for a place at a share of the way from the centre of its texel to the next.
/// Domain: share in [0, 1], clamped.
/// NaN: as 0.
/// Source: Sigg & Hadwiger 2005
GNOMON_KERNEL GNOMON_T(mip_filter_taps) mip_filter_taps_at(Real share)
{
    Real u = saturate_or_zero(share);
    Real v = Real(1) - u;
    // Six times the weights of the four texels.
    Real w0 = v * v * v;
    Real w1 = (Real(3) * u - Real(6)) * (u * u) + Real(4);
    Real w2 = (Real(3) * v - Real(6)) * (v * v) + Real(4);
    Real w3 = u * u * u;
    GNOMON_T(mip_filter_taps) r;
    r.first = w1 / (w0 + w1) - Real(1);
    r.second = w3 / (w2 + w3) + Real(1);
    r.weight = (w2 + w3) * GNOMON_LITERAL(mip_filter_sixth);
    return r;
}

GNOMON_NAMESPACE_END
#endif
