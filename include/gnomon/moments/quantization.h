// The sparse quantization transforms (Peters et al. 2017, Sec. 2.4 and 5.4.3): affine maps of the moments to channels
// in [0, 1], for storage as UNORM. Odd and even moments are transformed separately. The transforms spread the codes of
// the format as evenly as possible over the moments of depth distributions.
//
// Each channel is a polynomial in z that touches 0 and 1 on [-1, 1], and the determinant of the transform is the
// largest possible. The gain in entropy over storing the moments themselves is 4.21 bits for four moments and 12.51
// bits for six. tests/derivations computes the entries to full precision. The paper's entries for six moments are
// slightly off the optimum: up to 5e-3 away, and the channels exceed [0, 1] by 6e-9.
#ifndef GNOMON_MOMENTS_QUANTIZATION_H
#define GNOMON_MOMENTS_QUANTIZATION_H
#include "channels.h"
#include "moments.h"
GNOMON_NAMESPACE_BEGIN

/// The moments that a format without transform holds as they are.
GNOMON_KERNEL GNOMON_T(moments4) moments4_from_channels(GNOMON_T(channels4) c)
{
    GNOMON_T(moments4) b;
    b.b1 = c.c1;
    b.b2 = c.c2;
    b.b3 = c.c3;
    b.b4 = c.c4;
    return b;
}

/// The moments b as the channels of a format without transform.
GNOMON_KERNEL GNOMON_T(channels4) channels4_from_moments(GNOMON_T(moments4) b)
{
    GNOMON_T(channels4) c;
    c.c1 = b.b1;
    c.c2 = b.b2;
    c.c3 = b.b3;
    c.c4 = b.b4;
    return c;
}

/// The moments that a format without transform holds as they are.
GNOMON_KERNEL GNOMON_T(moments6) moments6_from_channels(GNOMON_T(channels6) c)
{
    GNOMON_T(moments6) b;
    b.b1 = c.c1;
    b.b2 = c.c2;
    b.b3 = c.c3;
    b.b4 = c.c4;
    b.b5 = c.c5;
    b.b6 = c.c6;
    return b;
}

/// The moments b as the channels of a format without transform.
GNOMON_KERNEL GNOMON_T(channels6) channels6_from_moments(GNOMON_T(moments6) b)
{
    GNOMON_T(channels6) c;
    c.c1 = b.b1;
    c.c2 = b.b2;
    c.c3 = b.b3;
    c.c4 = b.b4;
    c.c5 = b.b5;
    c.c6 = b.b6;
    return c;
}

GNOMON_CONSTANT(theta4_31, 0.8660254037844386);   // sqrt(3) / 2
GNOMON_CONSTANT(theta4_33, -0.38490017945975052); // -2 sqrt(3) / 9
GNOMON_CONSTANT(theta4_inverse11, -0.33333333333333331);
GNOMON_CONSTANT(theta4_inverse13, 1.7320508075688772);
GNOMON_CONSTANT(theta4_inverse33, 1.299038105676658);

/// Theta_4*: the four channels, in [0, 1], of four moments of signed depth.
/// Source: Peters 2017, Eq. 3
GNOMON_KERNEL GNOMON_T(channels4) theta4(GNOMON_T(moments4) b)
{
    GNOMON_T(channels4) c;
    c.c1 = Real(1.5) * b.b1 - Real(2) * b.b3 + Real(0.5);
    c.c2 = Real(4) * (b.b2 - b.b4);
    c.c3 = GNOMON_LITERAL(theta4_31) * b.b1 + GNOMON_LITERAL(theta4_33) * b.b3 + Real(0.5);
    c.c4 = Real(0.5) * (b.b2 + b.b4);
    return c;
}

/// The four moments of channels c: the inverse of theta4.
/// Source: Peters 2017, Eq. 3
GNOMON_KERNEL GNOMON_T(moments4) theta4_inverse(GNOMON_T(channels4) c)
{
    Real c1 = c.c1 - Real(0.5);
    Real c3 = c.c3 - Real(0.5);
    GNOMON_T(moments4) b;
    b.b1 = GNOMON_LITERAL(theta4_inverse11) * c1 + GNOMON_LITERAL(theta4_inverse13) * c3;
    b.b2 = Real(0.125) * c.c2 + c.c4;
    b.b3 = GNOMON_LITERAL(theta4_inverse33) * c3 - Real(0.75) * c1;
    b.b4 = c.c4 - Real(0.125) * c.c2;
    return b;
}

/// The biased moments (1 - alpha) b + alpha (0, bias, 0, bias), where b are the moments of channels c: theta4_inverse
/// and moments4_add_bias in one, with four products less.
/// Domain: alpha in [0, 1], as of moments4_add_bias.
/// NaN: NaN, lit.
/// Source: Peters 2017, Eq. 3; Peters 2017, Sec. 2.5
GNOMON_KERNEL GNOMON_T(moments4) theta4_inverse_add_bias(GNOMON_T(channels4) c, GNOMON_SETTING bias,
                                                         GNOMON_SETTING alpha)
{
    Real keep = Real(1) - alpha;
    Real c1 = c.c1 - Real(0.5);
    Real c3 = c.c3 - Real(0.5);
    Real c2 = (Real(0.125) * keep) * c.c2;
    Real c4 = keep * c.c4 + alpha * bias;
    GNOMON_T(moments4) b;
    b.b1 = (keep * GNOMON_LITERAL(theta4_inverse11)) * c1 + (keep * GNOMON_LITERAL(theta4_inverse13)) * c3;
    b.b2 = c4 + c2;
    b.b3 = (keep * GNOMON_LITERAL(theta4_inverse33)) * c3 - (Real(0.75) * keep) * c1;
    b.b4 = c4 - c2;
    return b;
}

// Rows 2 and 3 for the odd moments. Row 1 is T_5(z) / 2, with Chebyshev polynomials T_n.
GNOMON_CONSTANT(theta6_21, -1.8745771666290014);
GNOMON_CONSTANT(theta6_23, 4.204664766466248);
GNOMON_CONSTANT(theta6_25, -1.8300875998372463);
GNOMON_CONSTANT(theta6_31, 1.2643431422063351);
GNOMON_CONSTANT(theta6_33, -1.4716161665593888);
GNOMON_CONSTANT(theta6_35, 0.70727302435305361);
// Row 3 for the even moments: -sqrt(3)/3, 8 sqrt(3)/3, -16 sqrt(3)/9 and the offset 1/2 - 5 sqrt(3)/18. Rows 1 and 2
// are 4 z^2 (1 - z^2) and T_3(z)^2.
GNOMON_CONSTANT(theta6_62, -0.57735026918962573);
GNOMON_CONSTANT(theta6_64, 4.6188021535170058);
GNOMON_CONSTANT(theta6_66, -3.0792014356780042);
GNOMON_CONSTANT(theta6_60, 0.018874775675311862);
GNOMON_CONSTANT(theta6_inverse11, -0.02841260648183782);
GNOMON_CONSTANT(theta6_inverse12, 0.47582541301272185);
GNOMON_CONSTANT(theta6_inverse13, 1.552587193469116);
GNOMON_CONSTANT(theta6_inverse31, 0.10002244957859331);
GNOMON_CONSTANT(theta6_inverse32, 0.84496560893955308);
GNOMON_CONSTANT(theta6_inverse33, 1.0550119414818537);
GNOMON_CONSTANT(theta6_inverse51, 0.25890700149881596);
GNOMON_CONSTANT(theta6_inverse52, 0.90751156960796575);
GNOMON_CONSTANT(theta6_inverse53, 0.83358142889321829);
GNOMON_CONSTANT(theta6_inverse_sixth, 0.16666666666666666);
GNOMON_CONSTANT(theta6_inverse23, 0.8660254037844386);
GNOMON_CONSTANT(theta6_inverse63, 0.81189881604791125);

/// Theta_6*: the six channels, in [0, 1], of six moments of signed depth, three from the odd and three from
/// the even moments.
/// Source: Peters 2017, Sec. 5.4.3
GNOMON_KERNEL GNOMON_T(channels6) theta6(GNOMON_T(moments6) b)
{
    GNOMON_T(channels6) c;
    c.c1 = Real(2.5) * b.b1 - Real(10) * b.b3 + Real(8) * b.b5 + Real(0.5);
    c.c2 = GNOMON_LITERAL(theta6_21) * b.b1 + GNOMON_LITERAL(theta6_23) * b.b3 + GNOMON_LITERAL(theta6_25) * b.b5 +
           Real(0.5);
    c.c3 = GNOMON_LITERAL(theta6_31) * b.b1 + GNOMON_LITERAL(theta6_33) * b.b3 + GNOMON_LITERAL(theta6_35) * b.b5 +
           Real(0.5);
    c.c4 = Real(4) * (b.b2 - b.b4);
    c.c5 = Real(9) * b.b2 - Real(24) * b.b4 + Real(16) * b.b6;
    c.c6 = GNOMON_LITERAL(theta6_62) * b.b2 + GNOMON_LITERAL(theta6_64) * b.b4 + GNOMON_LITERAL(theta6_66) * b.b6 +
           GNOMON_LITERAL(theta6_60);
    return c;
}

/// The six moments of channels c: the inverse of theta6.
/// Source: Peters 2017, Sec. 5.4.3
GNOMON_KERNEL GNOMON_T(moments6) theta6_inverse(GNOMON_T(channels6) c)
{
    Real c1 = c.c1 - Real(0.5);
    Real c2 = c.c2 - Real(0.5);
    Real c3 = c.c3 - Real(0.5);
    Real c5 = GNOMON_LITERAL(theta6_inverse_sixth) * c.c5;
    Real c6 = c.c6 - GNOMON_LITERAL(theta6_60);
    GNOMON_T(moments6) b;
    b.b1 = GNOMON_LITERAL(theta6_inverse11) * c1 + GNOMON_LITERAL(theta6_inverse12) * c2 +
           GNOMON_LITERAL(theta6_inverse13) * c3;
    b.b3 = GNOMON_LITERAL(theta6_inverse31) * c1 + GNOMON_LITERAL(theta6_inverse32) * c2 +
           GNOMON_LITERAL(theta6_inverse33) * c3;
    b.b5 = GNOMON_LITERAL(theta6_inverse51) * c1 + GNOMON_LITERAL(theta6_inverse52) * c2 +
           GNOMON_LITERAL(theta6_inverse53) * c3;
    b.b2 = c5 + GNOMON_LITERAL(theta6_inverse23) * c6;
    b.b4 = (c5 + GNOMON_LITERAL(theta6_inverse23) * c6) - Real(0.25) * c.c4;
    b.b6 = (Real(0.21875) * c.c5 + GNOMON_LITERAL(theta6_inverse63) * c6) - Real(0.375) * c.c4;
    return b;
}

GNOMON_NAMESPACE_END
#endif
