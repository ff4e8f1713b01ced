// Convolution shadow maps (Annen, Mertens, Bekaert, Seidel & Kautz 2007): the shadow test is a square wave in z_f - z,
// and its Fourier series
//     1/2 + sum_k w_k sin(a_k (z_f - z)),   w_k = 2 / (pi (2 k - 1)),   a_k = (2 k - 1) span pi / 2,   k = 1..terms,
// separates into products of functions of z, which the map holds (a cosine and a sine per term), and functions of z_f.
// Unlike the other filters the series is no bound: truncated, it rings, and is 1/2 at z_f = z.
//
//     phase = convolution_encode(z, settings);          a texel's first cosine and sine
//     phase = convolution_next(phase);                  its next ones
//
//     state = convolution_begin(z_f, settings);
//     state = convolution_add(state, cosine, sine, convolution_weight(k, settings));       filtered, for k = 1, 2, ...
//     intensity = convolution_end(state);
#ifndef GNOMON_FILTERS_CONVOLUTION_H
#define GNOMON_FILTERS_CONVOLUTION_H
#include "../numerics/exp.h"
#include "../numerics/select.h"
#include "../numerics/trigonometry.h"
GNOMON_NAMESPACE_BEGIN

/// The number of terms. damping >= 0 attenuates term k by exp(-damping (k / terms)^2) against ringing (Annen et al.
/// 2007). offset is subtracted from z_f, so that a surface in its own map lies where the series has come down to 0: the
/// first zero is at 1.926 / (pi terms span), where the sine integral is pi / 2. span in (0, 1] is the part of a half
/// period that depths in [-1, 1] fill. A span below 1 keeps a near receiver before a far texel from reaching the next
/// edge of the wave.
GNOMON_STRUCT(convolution_settings) { Real terms, damping, offset, span; };

/// Cosine and sine of a_k z, and of the step from one term to the next.
GNOMON_STRUCT(convolution_phase) { Real cosine, sine, step_cosine, step_sine; };

/// The phase of the first term at z.
/// Domain: z in [-2, 2], span in [0, 1]. For a span of 0 the series is 1/2.
/// NaN: NaN.
GNOMON_KERNEL GNOMON_T(convolution_phase) convolution_phase_at(Real z, GNOMON_SETTING span)
{
    Real angle = GNOMON_LITERAL(trigonometry_half_pi) * span * z;
    cosine_sine first = polynomial_cosine_sine(angle);
    cosine_sine step = polynomial_cosine_sine(Real(2) * angle);
    GNOMON_T(convolution_phase) r;
    r.cosine = first.cosine;
    r.sine = first.sine;
    r.step_cosine = step.cosine;
    r.step_sine = step.sine;
    return r;
}

/// The phase of the first term of the texel of a depth z.
/// Domain: any z, limited to [-1, 1].
/// NaN: the far plane.
GNOMON_KERNEL GNOMON_T(convolution_phase) convolution_encode(Real z, GNOMON_T(convolution_settings) settings)
{
    return convolution_phase_at(clamp_or_high(z, Real(-1), Real(1)), settings.span);
}

/// The phase of the next term, by rotation.
/// Error: of both values of term k, 8 k 2^-p.
GNOMON_KERNEL GNOMON_T(convolution_phase) convolution_next(GNOMON_T(convolution_phase) phase)
{
    convolution_phase r = phase;
    r.cosine = phase.cosine * phase.step_cosine - phase.sine * phase.step_sine;
    r.sine = phase.sine * phase.step_cosine + phase.cosine * phase.step_sine;
    return r;
}

/// The weight w_k with its damping, k = 1, 2, ...: constant over texels and receivers, so best computed once.
/// Domain: terms at least 1, damping at least 0. An infinite damping leaves no term, and the series is 1/2.
/// NaN: NaN, which makes everything lit.
GNOMON_KERNEL Real convolution_weight(Real k, GNOMON_T(convolution_settings) settings)
{
    Real ratio = k / settings.terms;
    return GNOMON_LITERAL(trigonometry_two_over_pi) * polynomial_exp(-settings.damping * (ratio * ratio)) /
           (Real(2) * k - Real(1));
}

/// The receiver's phase at the next term, and the sum so far.
GNOMON_STRUCT(convolution_sum)
{
    GNOMON_T(convolution_phase) receiver;
    Real intensity;
};

/// The state before the first term.
/// Domain: any z_f, limited to [-1, 1].
/// NaN: lit, also for an offset or span of NaN.
GNOMON_KERNEL GNOMON_T(convolution_sum) convolution_begin(Real z_f, GNOMON_T(convolution_settings) settings)
{
    GNOMON_T(convolution_sum) r;
    r.receiver = convolution_phase_at(clamp_or_nan(z_f, Real(-1), Real(1)) - settings.offset, settings.span);
    r.intensity = Real(0.5);
    return r;
}

/// The state after the next term of the filtered map.
GNOMON_KERNEL GNOMON_T(convolution_sum) convolution_add(GNOMON_T(convolution_sum) state, Real cosine, Real sine,
                                                        GNOMON_SETTING weight)
{
    state.intensity = state.intensity + weight * (state.receiver.sine * cosine - state.receiver.cosine * sine);
    state.receiver = convolution_next(state.receiver);
    return state;
}

/// Shadow intensity in [0, 1].
/// NaN: 0, lit.
/// Error: against the exact series over 16 terms, 150 2^-p.
/// Source: Annen 2007, Sec. 3
GNOMON_KERNEL Real convolution_end(GNOMON_T(convolution_sum) state) { return saturate_or_zero(state.intensity); }

GNOMON_NAMESPACE_END
#endif
