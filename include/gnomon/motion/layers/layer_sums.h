// Sums that a texel of a layer's grid holds, and the visibility of a receiver through the layer (Andersson et al. 2015,
// Sec. 4.1 and 4.2). A sample in the layer or behind it has weight w = 1, one in front of the layer has none. A sample in the layer
// has opacity a = 1: where one sees past the layer, it is transparent. Per texel
//
//     variance       sums of w a z, w a z^2, w a, w                                layer_sums, Eq. 7
//     four moments   sums of w a z, ..., w a z^4, w a, w                           layer_moments4_sums
//     exponential    sums of w a exp(c z), w a, w                                  layer_exponential_sums
//
// where z is the layer's own depth, in [-1, 1] (layer_grid_own_depth). Filters and mip levels are linear in the sums. With
// the mean depths of what is opaque, Eq. 8, and the opacity a = sum w a / sum w, a layer lets through
//
//     V = 1 - a intensity                                                          Eq. 10
//
// and a receiver sees the product over all layers. A layer whose samples are all before the receiver has intensity 1, one
// whose samples are all behind has 0, with every bound. A sum of weights of 0 is no information: filters grow until
// there is some, and without any the layer counts as transparent.
//
//     share = layer_share_of(layer_of(layer_middle_depth(s), cuts), layer);
//     sums = layer_sums_add(sums, layer_grid_own_depth(grid, s.z, s.t), share);    into the texel at layer_grid_place(...)
//
//     visibility = 1, then visibility * layer_visibility(sums, layer_grid_own_depth(grid, z_r - bias, t_r), minimum)
//                                                                                  for all layers with their filtered sums
#ifndef GNOMON_MOTION_LAYERS_LAYER_SUMS_H
#define GNOMON_MOTION_LAYERS_LAYER_SUMS_H
#include "../../filters/exponential.h"
#include "../../filters/variance.h"
#include "../../moments/bias.h"
#include "../../moments/certified4.h"
#include "layer_grid.h"
GNOMON_NAMESPACE_BEGIN

/// Opacity and weight of a sample for a layer, each 0 or 1.
GNOMON_STRUCT(layer_share) { Real opacity, weight; };

/// Opacity and weight for layer number `layer` of a sample that is in layer `at` (layer_of).
/// NaN: no weight for an `at` of NaN.
/// Source: Andersson 2015, Sec. 4.1
GNOMON_KERNEL GNOMON_T(layer_share) layer_share_of(Real at, Real layer)
{
    GNOMON_T(layer_share) r;
    r.opacity = gnomon_select(at == layer, Real(1), Real(0));
    r.weight = gnomon_select(layer <= at, Real(1), Real(0));
    return r;
}

/// Sums over samples of opacity times depth and its square, of opacity, and of weight, each times weight.
GNOMON_STRUCT(layer_sums) { Real z, zz, opacity, weight; };

/// The sums with one more sample at the layer's own depth z, by its share.
/// Domain: any z, limited to [-1, 1].
/// NaN: 1, which shadows least.
/// Source: Andersson 2015, Eq. 7
GNOMON_KERNEL GNOMON_T(layer_sums) layer_sums_add(GNOMON_T(layer_sums) sums, Real z, GNOMON_T(layer_share) share)
{
    Real a = share.weight * share.opacity;
    Real x = clamp_or_high(z, Real(-1), Real(1));
    sums.z = sums.z + a * x;
    sums.zz = sums.zz + a * (x * x);
    sums.opacity = sums.opacity + a;
    sums.weight = sums.weight + share.weight;
    return sums;
}

/// The visibility 1 - a intensity through a layer, where a = opacity / weight is its opacity and intensity is a bound on the
/// share of its samples before a receiver at the layer's own depth z: 1 behind all of them, 0 in front of all of them.
/// NaN: 1.
/// Source: Andersson 2015, Eq. 10
GNOMON_DETAIL_KERNEL Real layer_transmission(Real opacity, Real weight, Real intensity, Real z)
{
    Real bound = gnomon_select(Real(1) < z, Real(1), gnomon_select(Real(-1) < z, intensity, Real(0)));
    Real known = gnomon_select(Real(0) < weight, saturate_or_zero(opacity / weight), Real(0));
    return Real(1) - saturate_or_zero(known * bound);
}

/// The visibility of a receiver at the layer's own depth z through the layer, in [0, 1], by Cantelli's bound. A weight of 0
/// gives 1, a weight without opacity gives 1.
/// Domain: any z; minimum_variance at least 0, of the layer's own depth (layer_minimum_variance).
/// NaN: 1.
/// Error: r (1 + 4 q + sqrt q) + 2 2^-p, q as of cantelli_lower, r = (n + 4) 2^-p for sums over n samples.
/// Source: Andersson 2015, Eq. 8; Andersson 2015, Eq. 9; Andersson 2015, Eq. 10
GNOMON_KERNEL Real layer_visibility(GNOMON_T(layer_sums) sums, Real z, GNOMON_SETTING minimum_variance)
{
    GNOMON_T(variance_moments) b;
    b.mean = sums.z / sums.opacity;
    b.square = sums.zz / sums.opacity;
    return layer_transmission(sums.opacity, sums.weight, cantelli_lower(b, z, minimum_variance), z);
}

/// Sums over samples of opacity times the powers of depth, of opacity, and of weight, each times weight.
GNOMON_STRUCT(layer_moments4_sums) { Real b1, b2, b3, b4, opacity, weight; };

/// The sums with one more sample at the layer's own depth z, by its share.
/// Domain: any z, limited to [-1, 1].
/// NaN: 1, which shadows least.
GNOMON_KERNEL GNOMON_T(layer_moments4_sums) layer_moments4_add(GNOMON_T(layer_moments4_sums) sums, Real z,
                                                               GNOMON_T(layer_share) share)
{
    Real a = share.weight * share.opacity;
    moments4 b = moments4_from_depth(clamp_or_high(z, Real(-1), Real(1)));
    sums.b1 = sums.b1 + a * b.b1;
    sums.b2 = sums.b2 + a * b.b2;
    sums.b3 = sums.b3 + a * b.b3;
    sums.b4 = sums.b4 + a * b.b4;
    sums.opacity = sums.opacity + a;
    sums.weight = sums.weight + share.weight;
    return sums;
}

GNOMON_CONSTANT(layer_moments4_noise, 3.3e-8); // 1.1 times 2^-25, one rounding to float
GNOMON_CONSTANT(layer_moments4_weight, 3e-7);  // the weight of the bias for one rounding

/// The visibility of a receiver at the layer's own depth z through the layer, in [0, 1], by a certified bound from four
/// moments. roundings is a bound on the number of roundings to float behind each sum: the samples of a texel and one more, and
/// those of filters and mip levels. What they leave of the moments grows by the inverse of the opacity, and so does the bias.
/// Domain: any z; roundings at least 1, clamped. A weight of 0 gives 1, a weight without opacity gives 1.
/// NaN: 1.
/// Error: never darker than the samples, but for 1e-6 in float and 1e-9 in double.
/// Source: Andersson 2015, Eq. 10; Peters 2017, Alg. 1
GNOMON_KERNEL Real layer_moments4_visibility(GNOMON_T(layer_moments4_sums) sums, Real z, GNOMON_SETTING roundings)
{
    Real share = Real(1) / sums.opacity;
    GNOMON_T(moments4) b;
    b.b1 = sums.b1 * share;
    b.b2 = sums.b2 * share;
    b.b3 = sums.b3 * share;
    b.b4 = sums.b4 * share;
    Real n = gnomon_max(Real(1), roundings) * (sums.weight * share);
    Real alpha = bias_weight_of_roundings(GNOMON_LITERAL(layer_moments4_weight), n);
    GNOMON_T(moments4) noise;
    noise.b1 = n * GNOMON_LITERAL(layer_moments4_noise);
    noise.b2 = noise.b1;
    noise.b3 = noise.b1;
    noise.b4 = noise.b1;
    hankel4 h = hankel4_constant_bias(b, GNOMON_LITERAL(bias4_raw_b2), GNOMON_LITERAL(bias4_raw_b4), alpha);
    Real intensity =
        certified4_constant_bias_lower(h, noise, GNOMON_LITERAL(bias4_raw_b2), GNOMON_LITERAL(bias4_raw_b4), alpha, z);
    return layer_transmission(sums.opacity, sums.weight, intensity, z);
}

/// Sums over samples of opacity times exp(c z), of opacity, and of weight, each times weight.
GNOMON_STRUCT(layer_exponential_sums) { Real warped, opacity, weight; };

/// The sums with one more sample at the layer's own depth z, by its share.
/// Domain: any z, limited to [-1, 1]; settings as for exponential_intensity.
/// NaN: 1, which shadows least.
GNOMON_KERNEL GNOMON_T(layer_exponential_sums) layer_exponential_add(GNOMON_T(layer_exponential_sums) sums, Real z,
                                                                     GNOMON_T(layer_share) share,
                                                                     GNOMON_T(exponential_settings) settings)
{
    Real a = share.weight * share.opacity;
    sums.warped = sums.warped + a * exponential_encode(z, settings).warped;
    sums.opacity = sums.opacity + a;
    sums.weight = sums.weight + share.weight;
    return sums;
}

/// The visibility of a receiver at the layer's own depth z through the layer, in [0, 1], by Markov's bound. A weight of 0
/// gives 1, a weight without opacity gives 1.
/// Domain: any z; settings as for exponential_intensity.
/// NaN: 1.
/// Error: (c + n + 7) 2^-p, c the exponent, for sums over n samples.
/// Source: Andersson 2015, Eq. 10; Annen 2008
GNOMON_KERNEL Real layer_exponential_visibility(GNOMON_T(layer_exponential_sums) sums, Real z,
                                                GNOMON_T(exponential_settings) settings)
{
    GNOMON_T(exponential_moment) b;
    b.warped = sums.warped / sums.opacity;
    return layer_transmission(sums.opacity, sums.weight, exponential_intensity(b, z, settings), z);
}

GNOMON_NAMESPACE_END
#endif
