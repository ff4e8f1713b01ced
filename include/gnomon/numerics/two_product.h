// Error-free transformations: the difference or product of two numbers as the rounded result and its exact error
// (Dekker 1971; Knuth 1997; Ogita, Rump & Oishi 2005). A double word, the unevaluated sum of such a pair, carries both
// through further operations, so that differences of products keep the digits that cancellation would lose.
#ifndef GNOMON_NUMERICS_TWO_PRODUCT_H
#define GNOMON_NUMERICS_TWO_PRODUCT_H
#include "../portable.h"
GNOMON_NAMESPACE_BEGIN

/// The unevaluated sum high + low.
GNOMON_STRUCT(double_word) { Real high, low; };

/// The error a b - p of the rounded product p, without a fused multiply-add: both factors are split into halves whose
/// products are exact. In this order of summation all sums are exact, and an error of zero is +0, as by a fused
/// multiply-add.
/// Domain: as for two_product.
/// Source: Dekker 1971
GNOMON_DETAIL_KERNEL Real dekker_product_error(Real a, Real b, Real p)
{
    Real ah = gnomon_high_part(a);
    Real bh = gnomon_high_part(b);
    Real al = gnomon_difference(a, ah);
    Real bl = gnomon_difference(b, bh);
    Real e = gnomon_difference(ah * bh, p);
    return gnomon_sum(gnomon_sum(gnomon_sum(e, al * bh), ah * bl), al * bl);
}

/// a b exactly, as the rounded product and its error. Fused multiply-add and splitting give the same bits.
/// Domain: |a|, |b| <= 2^100 and |a b| = 0 or >= 2^-100 in float; 2^900 and 2^-900 in double.
/// Error: none; for smaller products low is off by at most two of the smallest denormals, since each of the four
/// products of the split route rounds by half of one.
/// Source: Dekker 1971; Ogita, Rump & Oishi 2005
GNOMON_KERNEL GNOMON_T(double_word) two_product(Real a, Real b)
{
    GNOMON_T(double_word) r;
    if (GNOMON_FUSED) {
        r.high = gnomon_fma(a, b, Real(-0.0)); // kept, as gnomon_product is: two fused products read it
        r.low = gnomon_fma(a, b, -r.high);
    } else {
        r.high = gnomon_product(a, b);
        r.low = dekker_product_error(a, b, r.high);
    }
    return r;
}

/// a - b exactly, as the rounded difference and its error, for magnitudes in any order.
/// Source: Knuth 1997, Sec. 4.2.2
GNOMON_KERNEL GNOMON_T(double_word) two_difference(Real a, Real b)
{
    GNOMON_T(double_word) r;
    r.high = gnomon_difference(a, b);
    Real bv = gnomon_difference(r.high, a);
    Real av = gnomon_difference(r.high, bv);
    r.low = gnomon_difference(gnomon_difference(a, av), gnomon_sum(b, bv));
    return r;
}

/// a - b exactly, as the rounded difference and its error.
/// Domain: |a| >= |b| or a = 0; elsewhere low is off by up to a rounding of b.
/// Source: Dekker 1971
GNOMON_KERNEL GNOMON_T(double_word) two_difference_ordered(Real a, Real b)
{
    GNOMON_T(double_word) r;
    r.high = gnomon_difference(a, b);
    r.low = gnomon_difference(gnomon_difference(a, r.high), b);
    return r;
}

/// c - a b as a double word, for magnitudes in any order.
/// Domain: as for two_product.
/// Error: 2 u^2 (|c| + |a b|), u = 2^-p.
GNOMON_KERNEL GNOMON_T(double_word) subtract_product(Real c, Real a, Real b)
{
    double_word p = two_product(a, b);
    double_word r = two_difference(c, p.high);
    r.low = gnomon_difference(r.low, p.low);
    return r;
}

/// c - a b as a double word.
/// Domain: |c| >= |a b|, elsewhere low is off by up to a rounding of a b; as for two_product.
/// Error: 2 u^2 (|c| + |a b|), u = 2^-p.
GNOMON_KERNEL GNOMON_T(double_word) subtract_product_ordered(Real c, Real a, Real b)
{
    double_word p = two_product(a, b);
    double_word r = two_difference_ordered(c, p.high);
    r.low = gnomon_difference(r.low, p.low);
    return r;
}

/// c - a b, rounded. Where c and a b cancel, their difference is exact.
/// Domain: as for two_product.
/// Error: 2 roundings of the result, also under cancellation.
GNOMON_KERNEL Real subtract_product_rounded(Real c, Real a, Real b)
{
    double_word p = two_product(a, b);
    return gnomon_difference(c, p.high) - p.low;
}

/// a b - c d for double words, as a double word.
/// Domain: each low is at most 2^-20 of its high in float, 2^-49 in double.
/// Error: 2^-40 (|a b| + |c d|) in float, 2^-98 (|a b| + |c d|) in double.
GNOMON_DETAIL_KERNEL GNOMON_T(double_word) double_word_minor(GNOMON_T(double_word) a, GNOMON_T(double_word) b,
                                                             GNOMON_T(double_word) c, GNOMON_T(double_word) d)
{
    double_word p = two_product(a.high, b.high);
    double_word q = two_product(c.high, d.high);
    double_word r = two_difference(p.high, q.high);
    Real cross = (a.high * b.low + a.low * b.high) - (c.high * d.low + c.low * d.high);
    r.low = r.low + ((p.low - q.low) + (cross + (a.low * b.low - c.low * d.low)));
    return r;
}

/// a c - b^2 for double words, rounded.
/// Domain: as for double_word_minor.
/// Error: 2 roundings of the result beside that of double_word_minor.
GNOMON_DETAIL_KERNEL Real double_word_determinant(GNOMON_T(double_word) a, GNOMON_T(double_word) b,
                                                  GNOMON_T(double_word) c)
{
    double_word p = two_product(a.high, c.high);
    double_word q = two_product(b.high, b.high);
    Real cross = (a.high * c.low + a.low * (c.high + c.low)) - b.low * ((b.high + b.high) + b.low);
    return gnomon_difference(p.high, q.high) + ((p.low - q.low) + cross);
}

GNOMON_NAMESPACE_END
#endif
