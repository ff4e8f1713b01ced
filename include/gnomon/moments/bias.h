// Biasing: moments that storage has rounded may belong to no distribution, so they are moved inwards (Peters et al.
// 2017, 2.5).
//
// If storage moves the stored vector b by e, at most delta in each channel, and b* lies r from the boundary of the
// valid vectors in the maximum norm, then (1 - alpha) (b + e) + alpha b* = (1 - alpha) b + alpha (b* + e (1 - alpha) /
// alpha), and from alpha = delta / (delta + r) on the last term is valid, too. The moments are those of (1 - alpha) Z +
// alpha Z', so intensities exceed Z(z < z_f) by alpha at most. The weight belongs to the format and to its history,
// since n roundings need n delta; it is no knob. Below are the vectors b* with the largest r, derived by
// tests/derivations, beside the paper's, which have the largest Euclidean distance. Odd entries are zero by symmetry.
//
// Two ways to apply it:
//   interpolated  moments4_add_bias and then hankel4_plain, as the paper does: for UNORM and half floats.
//   kept apart    hankel4_constant_bias: the same mixture without rounding it away; 100 times less error in float.
// A bias that depends on the moments, raised pivots, was the default once and darkened lit surfaces by up to 0.79; a
// certificate (certified4.h) leaks less than a constant bias and never does (docs/decisions/2-bias.md).
#ifndef GNOMON_MOMENTS_BIAS_H
#define GNOMON_MOMENTS_BIAS_H
#include "moments.h"
GNOMON_NAMESPACE_BEGIN

// Four moments as they are: r = 0.10147 against 0.10090.
GNOMON_CONSTANT(bias4_raw_b2, 0.41397147664677789);
GNOMON_CONSTANT(bias4_raw_b4, 0.41397147664677789);
GNOMON_CONSTANT(bias4_raw_paper_b2, 0.375);
GNOMON_CONSTANT(bias4_raw_paper_b4, 0.375);

// Four moments after the sparse transform (quantization.h): r = 0.21652 against 0.20490.
GNOMON_CONSTANT(bias4_theta_b2, 0.66391434671237689);
GNOMON_CONSTANT(bias4_theta_b4, 0.66391434671237689);
GNOMON_CONSTANT(bias4_theta_paper_b2, 0.628);
GNOMON_CONSTANT(bias4_theta_paper_b4, 0.628);

// Six moments as they are: r = 0.01629 against 0.01180, where the paper has the vector meant for its transform.
GNOMON_CONSTANT(bias6_raw_b2, 0.42015374983242804);
GNOMON_CONSTANT(bias6_raw_b4, 0.2876068288776971);
GNOMON_CONSTANT(bias6_raw_b6, 0.25730795870391842);

// Six moments after the transform: r = 0.14575 against 0.13990.
GNOMON_CONSTANT(bias6_theta_b2, 0.61284694380550628);
GNOMON_CONSTANT(bias6_theta_b4, 0.52469968779048582);
GNOMON_CONSTANT(bias6_theta_b6, 0.50463026403505464);
GNOMON_CONSTANT(bias6_paper_b2, 0.5566);
GNOMON_CONSTANT(bias6_paper_b4, 0.489);
GNOMON_CONSTANT(bias6_paper_b6, 0.47869382);

/// (1 - alpha) b + alpha b*, by interpolation.
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

/// (1 - alpha) b + alpha b*, by interpolation.
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
