// Translucent occluders (Peters et al. 2017, Sec. 3): moments of the depth distribution in which each fragment of a stack
// has as weight the light that it takes away,
//     Z = sum_k weight_k delta(z_k),    weight_k = alpha_k prod of (1 - alpha_j) over the fragments j in front of k,
// so that Z(z < z_f) = 1 - prod of (1 - alpha_k) over z_k < z_f, the intensity of the stack's shadow. What is behind all
// fragments, an opaque surface or the far plane, has the rest of the weight.
//
//     back to front    b = the moments of the surface behind;  b = moments4_over(b, z, alpha) for each fragment
//     front to back    state = front_to_back_begin(alpha), then front_to_back_add(state, alpha): moments4_add the
//                      fragment's moments with state.weight, in the end those of the surface behind with state.transmittance
//
// A GPU blends back to front: over() of each channel, with the alpha of the fragment. Weights sum to 1, so that affine
// transforms commute with blending: channels of any format are blended as stored (passes/blend.hpp). For coloured occluders
// use one map for each channel of light, with the opacity for that light. In any order, a fragment that survives in a sample
// with probability alpha has this distribution as the mean over samples (stochastic transparency; Enderton et al. 2010).
//
// Every blend rounds to the format. Later blends shrink an error by 1 - alpha, so of n roundings by delta
//     delta (1 - (1 - alpha)^n) / alpha <= delta / alpha
// is left: blend_roundings, for storage/moments4_blended.h and moments6_blended.h. A least alpha hence limits the error,
// and fragments below it are discarded (alpha test). Where alpha |above - below| is less than half a code, a blend changes
// nothing: many faint fragments vanish, for which no bias makes up. Absorbance (absorbance.h) loses less of them.
#ifndef GNOMON_MOMENTS_TRANSLUCENCY_H
#define GNOMON_MOMENTS_TRANSLUCENCY_H
#include "../numerics/select.h"
#include "moments.h"
GNOMON_NAMESPACE_BEGIN

/// The over operator (1 - alpha) below + alpha above, for one channel: a fragment of opacity alpha in front of below. An
/// alpha of 0 leaves below, and 1 leaves above, whatever the other is.
/// Domain: any alpha, clamped to [0, 1].
/// NaN: an alpha of NaN counts as 0, no fragment; other NaN stay.
/// Error: 2 2^-p for below and above in [-1, 1].
/// Source: Porter & Duff 1984; Peters 2017, Sec. 3.2
GNOMON_KERNEL Real over(Real below, Real above, Real alpha)
{
    Real a = saturate_or_zero(alpha);
    Real mixed = (Real(1) - a) * below + a * above;
    return gnomon_select(Real(0) < a, gnomon_select(a < Real(1), mixed, above), below);
}

/// The four moments of a fragment at depth z of opacity alpha, in front of what has the moments below.
/// Domain: any z, limited to [-1, 1]; any alpha, clamped to [0, 1].
/// NaN: for z the far plane, which shadows nothing; an alpha of NaN counts as 0, no fragment.
/// Source: Peters 2017, Sec. 3.2
GNOMON_KERNEL GNOMON_T(moments4) moments4_over(GNOMON_T(moments4) below, Real z, Real alpha)
{
    moments4 b = moments4_from_depth(clamp_or_high(z, Real(-1), Real(1)));
    b.b1 = over(below.b1, b.b1, alpha);
    b.b2 = over(below.b2, b.b2, alpha);
    b.b3 = over(below.b3, b.b3, alpha);
    b.b4 = over(below.b4, b.b4, alpha);
    return b;
}

/// The six moments of a fragment at depth z of opacity alpha, in front of what has the moments below.
/// Domain: any z, limited to [-1, 1]; any alpha, clamped to [0, 1].
/// NaN: for z the far plane, which shadows nothing; an alpha of NaN counts as 0, no fragment.
/// Source: Peters 2017, Sec. 3.2
GNOMON_KERNEL GNOMON_T(moments6) moments6_over(GNOMON_T(moments6) below, Real z, Real alpha)
{
    moments6 b = moments6_from_depth(clamp_or_high(z, Real(-1), Real(1)));
    b.b1 = over(below.b1, b.b1, alpha);
    b.b2 = over(below.b2, b.b2, alpha);
    b.b3 = over(below.b3, b.b3, alpha);
    b.b4 = over(below.b4, b.b4, alpha);
    b.b5 = over(below.b5, b.b5, alpha);
    b.b6 = over(below.b6, b.b6, alpha);
    return b;
}

/// A fold over fragments front to back: the weight of the latest fragment, and the transmittance of all up to it, which is
/// the weight of what is behind them.
GNOMON_STRUCT(front_to_back) { Real weight, transmittance; };

/// The state after the nearest fragment, of opacity alpha.
/// Domain: any alpha, clamped to [0, 1].
/// NaN: an alpha of NaN counts as 0, no fragment.
GNOMON_KERNEL GNOMON_T(front_to_back) front_to_back_begin(Real alpha)
{
    GNOMON_T(front_to_back) state;
    state.weight = saturate_or_zero(alpha);
    state.transmittance = Real(1) - state.weight;
    return state;
}

/// The state after a further fragment, of opacity alpha, behind those before.
/// Domain: any alpha, clamped to [0, 1].
/// NaN: an alpha of NaN counts as 0, no fragment.
GNOMON_KERNEL GNOMON_T(front_to_back) front_to_back_add(GNOMON_T(front_to_back) state, Real alpha)
{
    Real a = saturate_or_zero(alpha);
    state.weight = state.transmittance * a;
    state.transmittance = state.transmittance * (Real(1) - a);
    return state;
}

/// The least opacity of the alpha test of Peters et al.
GNOMON_CONSTANT(alpha_test_one_percent, 0.01);

GNOMON_CONSTANT(blend_least_alpha, 5.9604644775390625e-8); // 2^-24

/// The largest error that blends leave in a texel, in roundings of one blend, for any number of fragments of opacity
/// least_alpha and more: 1 / least_alpha.
/// Domain: any least_alpha, clamped to [2^-24, 1].
/// NaN: 2^24.
/// Source: Peters 2017, Sec. 3.3
GNOMON_KERNEL Real blend_roundings(Real least_alpha)
{
    return Real(1) / gnomon_max(saturate_or_zero(least_alpha), GNOMON_LITERAL(blend_least_alpha));
}

/// The largest error that blends of so many layers leave in a texel, in roundings of one blend: (1 - (1 - a)^n) / a for
/// a = least_alpha and n = layers, up to a factor of at most 1.16, by which the result is larger.
/// Domain: any least_alpha, clamped to [2^-24, 1]; layers >= 1, clamped.
/// NaN: a least_alpha of NaN counts as 2^-24; layers of NaN as any number.
/// Source: Peters 2017, Sec. 3.3
GNOMON_KERNEL Real blend_roundings_of_layers(Real least_alpha, Real layers)
{
    Real a = gnomon_max(saturate_or_zero(least_alpha), GNOMON_LITERAL(blend_least_alpha));
    Real further = gnomon_max(Real(1), layers) - Real(1);
    Real few = (further + Real(1)) / (Real(1) + Real(0.5) * (further * a));
    return gnomon_min(few, Real(1) / a);
}

/// The roundings of a texel in all: one of its first store, and `each` for every further one.
GNOMON_DETAIL_KERNEL Real blended_roundings(Real further, GNOMON_SETTING each)
{
    return Real(1) + each * gnomon_max(Real(0), further);
}

// Half floats may be truncated, which errs twice as far. A blend of floats rounds 1 - alpha, two products and a sum.
GNOMON_CONSTANT(blended_half_roundings, 2.0);
GNOMON_CONSTANT(blended_float_roundings, 3.5);

GNOMON_NAMESPACE_END
#endif
