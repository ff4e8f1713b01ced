// The sparse quantization transforms: affine maps of the moments into [0, 1], odd and even ones apart, that spread what
// a UNORM format can tell apart as evenly as possible over what depth distributions need (Peters et al.
// 2017, 2.4, 5.4.3).
//
// Each output is a polynomial in z that touches 0 and 1 on [-1, 1], and their determinant is the largest: an entropy
// gain of 4.21 bits over storing four moments as they are, 12.51 bits for six. Entries to full precision by
// tests/derivations; the paper's digits for six moments are a little off the optimum (range exceeded by 6e-9, entries
// up to 5e-3 away).
#ifndef GNOMON_MOMENTS_QUANTIZATION_H
#define GNOMON_MOMENTS_QUANTIZATION_H
#include "moments.h"
GNOMON_NAMESPACE_BEGIN

GNOMON_CONSTANT(theta4_31, 0.8660254037844386);   // sqrt(3) / 2
GNOMON_CONSTANT(theta4_33, -0.38490017945975052); // -2 sqrt(3) / 9
GNOMON_CONSTANT(theta4_inverse11, -0.33333333333333331);
GNOMON_CONSTANT(theta4_inverse13, 1.7320508075688772);
GNOMON_CONSTANT(theta4_inverse33, 1.299038105676658);

/// Theta_4* (paper, Equation 3): four moments of signed depth to four channels in [0, 1].
GNOMON_KERNEL GNOMON_T(moments4) theta4(GNOMON_T(moments4) b)
{
    GNOMON_T(moments4) c;
    c.b1 = Real(1.5) * b.b1 - Real(2) * b.b3 + Real(0.5);
    c.b2 = Real(4) * (b.b2 - b.b4);
    c.b3 = GNOMON_LITERAL(theta4_31) * b.b1 + GNOMON_LITERAL(theta4_33) * b.b3 + Real(0.5);
    c.b4 = Real(0.5) * (b.b2 + b.b4);
    return c;
}

/// The inverse of theta4: channels to moments.
GNOMON_KERNEL GNOMON_T(moments4) theta4_inverse(GNOMON_T(moments4) c)
{
    Real c1 = c.b1 - Real(0.5);
    Real c3 = c.b3 - Real(0.5);
    GNOMON_T(moments4) b;
    b.b1 = GNOMON_LITERAL(theta4_inverse11) * c1 + GNOMON_LITERAL(theta4_inverse13) * c3;
    b.b2 = Real(0.125) * c.b2 + c.b4;
    b.b3 = GNOMON_LITERAL(theta4_inverse33) * c3 - Real(0.75) * c1;
    b.b4 = c.b4 - Real(0.125) * c.b2;
    return b;
}

/// (1 - alpha) b + alpha (0, bias, 0, bias) for the moments b of channels c: theta4_inverse, then moments4_add_bias, in
/// four products less.
GNOMON_KERNEL GNOMON_T(moments4) theta4_inverse_add_bias(GNOMON_T(moments4) c, GNOMON_SETTING bias,
                                                         GNOMON_SETTING alpha)
{
    Real keep = Real(1) - alpha;
    Real c1 = c.b1 - Real(0.5);
    Real c3 = c.b3 - Real(0.5);
    Real c2 = (Real(0.125) * keep) * c.b2;
    Real c4 = keep * c.b4 + alpha * bias;
    GNOMON_T(moments4) b;
    b.b1 = (keep * GNOMON_LITERAL(theta4_inverse11)) * c1 + (keep * GNOMON_LITERAL(theta4_inverse13)) * c3;
    b.b2 = c4 + c2;
    b.b3 = (keep * GNOMON_LITERAL(theta4_inverse33)) * c3 - (Real(0.75) * keep) * c1;
    b.b4 = c4 - c2;
    return b;
}

// Odd rows 2 and 3; row 1 is T_5(z) / 2.
GNOMON_CONSTANT(theta6_21, -1.8745771666290014);
GNOMON_CONSTANT(theta6_23, 4.204664766466248);
GNOMON_CONSTANT(theta6_25, -1.8300875998372463);
GNOMON_CONSTANT(theta6_31, 1.2643431422063351);
GNOMON_CONSTANT(theta6_33, -1.4716161665593888);
GNOMON_CONSTANT(theta6_35, 0.70727302435305361);
// Even row 3: -sqrt(3)/3, 8 sqrt(3)/3, -16 sqrt(3)/9 and 1/2 - 5 sqrt(3)/18; rows 1 and 2 are 4 z^2 (1 - z^2) and
// T_3(z)^2.
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

/// Theta_6* (paper, 5.4.3): six moments of signed depth to six channels in [0, 1]: three from the odd, three from the
/// even moments.
GNOMON_KERNEL GNOMON_T(moments6) theta6(GNOMON_T(moments6) b)
{
    GNOMON_T(moments6) c;
    c.b1 = Real(2.5) * b.b1 - Real(10) * b.b3 + Real(8) * b.b5 + Real(0.5);
    c.b2 = GNOMON_LITERAL(theta6_21) * b.b1 + GNOMON_LITERAL(theta6_23) * b.b3 + GNOMON_LITERAL(theta6_25) * b.b5 +
           Real(0.5);
    c.b3 = GNOMON_LITERAL(theta6_31) * b.b1 + GNOMON_LITERAL(theta6_33) * b.b3 + GNOMON_LITERAL(theta6_35) * b.b5 +
           Real(0.5);
    c.b4 = Real(4) * (b.b2 - b.b4);
    c.b5 = Real(9) * b.b2 - Real(24) * b.b4 + Real(16) * b.b6;
    c.b6 = GNOMON_LITERAL(theta6_62) * b.b2 + GNOMON_LITERAL(theta6_64) * b.b4 + GNOMON_LITERAL(theta6_66) * b.b6 +
           GNOMON_LITERAL(theta6_60);
    return c;
}

/// The inverse of theta6: channels to moments.
GNOMON_KERNEL GNOMON_T(moments6) theta6_inverse(GNOMON_T(moments6) c)
{
    Real c1 = c.b1 - Real(0.5);
    Real c2 = c.b2 - Real(0.5);
    Real c3 = c.b3 - Real(0.5);
    Real c5 = GNOMON_LITERAL(theta6_inverse_sixth) * c.b5;
    Real c6 = c.b6 - GNOMON_LITERAL(theta6_60);
    GNOMON_T(moments6) b;
    b.b1 = GNOMON_LITERAL(theta6_inverse11) * c1 + GNOMON_LITERAL(theta6_inverse12) * c2 +
           GNOMON_LITERAL(theta6_inverse13) * c3;
    b.b3 = GNOMON_LITERAL(theta6_inverse31) * c1 + GNOMON_LITERAL(theta6_inverse32) * c2 +
           GNOMON_LITERAL(theta6_inverse33) * c3;
    b.b5 = GNOMON_LITERAL(theta6_inverse51) * c1 + GNOMON_LITERAL(theta6_inverse52) * c2 +
           GNOMON_LITERAL(theta6_inverse53) * c3;
    b.b2 = c5 + GNOMON_LITERAL(theta6_inverse23) * c6;
    b.b4 = (c5 + GNOMON_LITERAL(theta6_inverse23) * c6) - Real(0.25) * c.b4;
    b.b6 = (Real(0.21875) * c.b5 + GNOMON_LITERAL(theta6_inverse63) * c6) - Real(0.375) * c.b4;
    return b;
}

GNOMON_NAMESPACE_END
#endif
