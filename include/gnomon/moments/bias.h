// Biasing: rounding in storage can turn moments into numbers that belong to no distribution, so they are moved inwards
// (Peters et al. 2017, Sec. 2.5).
//
// Let storage move the stored vector b by e, at most delta in each channel, and let r be the distance in the maximum
// norm from b* to the boundary of the valid vectors. Interpolation by alpha gives
//     (1 - alpha) (b + e) + alpha b* = (1 - alpha) b + alpha (b* + e (1 - alpha) / alpha),
// whose last term is valid from alpha = delta / (delta + r) on. The result has the moments of the mixture (1 - alpha) Z
// + alpha Z', so intensities exceed Z(z < z_f) by at most alpha. n roundings need n delta. The weight alpha is
// therefore a property of the format and of the number of roundings, not a setting.
//
// The vectors b* below have the largest r and are computed by tests/derivations. Beside them stand the paper's vectors,
// which have the largest Euclidean distance. Odd entries are 0 by symmetry.
//
// A bias is applied in one of two ways:
//   interpolated    moments4_add_bias, then hankel4_from_moments, as in the paper: for UNORM and half floats
//   kept apart      hankel4_constant_bias, the same mixture with 100 times less rounding error: for floats
// Certificates (certified4.h) leak less than a constant bias and never darken a lit surface. A bias that depends on the
// moments leaks less still, but darkens lit surfaces by up to 0.79 (docs/decisions/2-bias.md).
#ifndef GNOMON_MOMENTS_BIAS_H
#define GNOMON_MOMENTS_BIAS_H
#include "moments.h"
GNOMON_NAMESPACE_BEGIN

// Four moments without transform: r = 0.10147; the paper's vector has 0.10090.
GNOMON_CONSTANT(bias4_raw_b2, 0.41397147664677789);
GNOMON_CONSTANT(bias4_raw_b4, 0.41397147664677789);
GNOMON_CONSTANT(bias4_raw_paper_b2, 0.375);
GNOMON_CONSTANT(bias4_raw_paper_b4, 0.375);

// Four moments after the sparse transform (quantization.h): r = 0.21652; the paper's vector has 0.20490.
GNOMON_CONSTANT(bias4_theta_b2, 0.66391434671237689);
GNOMON_CONSTANT(bias4_theta_b4, 0.66391434671237689);
GNOMON_CONSTANT(bias4_theta_paper_b2, 0.628);
GNOMON_CONSTANT(bias4_theta_paper_b4, 0.628);

// Six moments without transform: r = 0.01629; the paper uses the vector for the transform here, which has 0.01180.
GNOMON_CONSTANT(bias6_raw_b2, 0.42015374983242804);
GNOMON_CONSTANT(bias6_raw_b4, 0.2876068288776971);
GNOMON_CONSTANT(bias6_raw_b6, 0.25730795870391842);

// Six moments after the sparse transform: r = 0.14575; the paper's vector has 0.13990.
GNOMON_CONSTANT(bias6_theta_b2, 0.61284694380550628);
GNOMON_CONSTANT(bias6_theta_b4, 0.52469968779048582);
GNOMON_CONSTANT(bias6_theta_b6, 0.50463026403505464);
GNOMON_CONSTANT(bias6_paper_b2, 0.5566);
GNOMON_CONSTANT(bias6_paper_b4, 0.489);
GNOMON_CONSTANT(bias6_paper_b6, 0.47869382);

/// The weight of a constant bias for n roundings, n w / (1 - w + n w), where w is the weight for one: if w >= delta / (delta
/// + r), the result is at least n delta / (n delta + r).
/// Domain: w in [0, 1]; n >= 1, clamped. An infinite n gives NaN, lit.
/// NaN: NaN, lit.
/// Error: 4 2^-p, relative.
GNOMON_KERNEL Real bias_weight_of_roundings(Real w, Real n)
{
    Real nw = gnomon_max(Real(1), n) * w;
    return nw / ((Real(1) - w) + nw);
}

/// The biased moments (1 - alpha) b + alpha b*, where b* = (0, bias2, 0, bias4).
/// Domain: alpha in [0, 1]. 0 is no bias; 1 leaves b* alone. Elsewhere the results are no moments, and intensities from them
/// are in [0, 1].
/// NaN: NaN, lit.
/// Source: Peters 2017, Sec. 2.5
GNOMON_KERNEL GNOMON_T(moments4) moments4_add_bias(GNOMON_T(moments4) b, GNOMON_SETTING bias2, GNOMON_SETTING bias4,
                                                   GNOMON_SETTING alpha)
{
    Real keep = Real(1) - alpha;
    b.b1 = keep * b.b1;
    b.b2 = keep * b.b2 + alpha * bias2;
    b.b3 = keep * b.b3;
    b.b4 = keep * b.b4 + alpha * bias4;
    return b;
}

/// The biased moments (1 - alpha) b + alpha b*, where b* = (0, bias2, 0, bias4, 0, bias6).
/// Domain: alpha in [0, 1]. 0 is no bias; 1 leaves b* alone. Elsewhere the results are no moments, and intensities from them
/// are in [0, 1].
/// NaN: NaN, lit.
/// Source: Peters 2017, Sec. 2.5; Peters 2017, Sec. 5.4.3
GNOMON_KERNEL GNOMON_T(moments6) moments6_add_bias(GNOMON_T(moments6) b, GNOMON_SETTING bias2, GNOMON_SETTING bias4,
                                                   GNOMON_SETTING bias6, GNOMON_SETTING alpha)
{
    Real keep = Real(1) - alpha;
    b.b1 = keep * b.b1;
    b.b2 = keep * b.b2 + alpha * bias2;
    b.b3 = keep * b.b3;
    b.b4 = keep * b.b4 + alpha * bias4;
    b.b5 = keep * b.b5;
    b.b6 = keep * b.b6 + alpha * bias6;
    return b;
}

GNOMON_NAMESPACE_END
#endif
