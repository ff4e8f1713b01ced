// Error-free transformations: a difference or product of two numbers as the rounded result and its exact error.
// A double word (high + low, unevaluated) carries such a pair on: Dekker 1971; Knuth, TAOCP 2, 4.2.2; Ogita, Rump &
// Oishi 2005.
#ifndef GNOMON_NUMERICS_TWO_PRODUCT_H
#define GNOMON_NUMERICS_TWO_PRODUCT_H
#include "../portable.h"
GNOMON_NAMESPACE_BEGIN

/// The unevaluated sum high + low.
GNOMON_STRUCT(double_word) { Real high, low; };

/// a b - p for p = a b rounded, without a fused multiply-add: both factors are split into halves whose products are
/// exact. Summed in this order an error of zero is +0, as the fused one is.
GNOMON_KERNEL Real dekker_product_error(Real a, Real b, Real p)
{
    Real sa = gnomon_product(GNOMON_SPLITTER, a); // contracted with what follows, it would leave no halves
    Real sb = gnomon_product(GNOMON_SPLITTER, b);
    Real ah = sa - gnomon_difference(sa, a);
    Real bh = sb - gnomon_difference(sb, b);
    Real al = a - ah;
    Real bl = b - bh;
    return (((ah * bh - p) + al * bh) + ah * bl) + al * bl;
}

/// a b exactly. Domain: |a|, |b| <= 2^100 and |a b| = 0 or >= 2^-100 in float (2^900, 2^-900 in double); there the
/// fused and the split route give the same bits. Below, low is within two of the smallest denormals of the
/// error: each of the split route's four products rounds by half of one.
GNOMON_KERNEL GNOMON_T(double_word) two_product(Real a, Real b)
{
    GNOMON_T(double_word) r;
    r.high = gnomon_product(a, b);
    if (GNOMON_FUSED) {
        r.low = gnomon_fma(a, b, -r.high);
    } else {
        r.low = dekker_product_error(a, b, r.high);
    }
    return r;
}

/// a - b exactly, whatever their order (Knuth).
GNOMON_KERNEL GNOMON_T(double_word) two_difference(Real a, Real b)
{
    GNOMON_T(double_word) r;
    r.high = gnomon_difference(a, b);
    Real bv = gnomon_difference(r.high, a);
    r.low = (a - (r.high - bv)) - (b + bv);
    return r;
}

/// a - b exactly where |a| >= |b| or a = 0 (Dekker); elsewhere low is off by up to a rounding of b.
GNOMON_KERNEL GNOMON_T(double_word) two_difference_ordered(Real a, Real b)
{
    GNOMON_T(double_word) r;
    r.high = gnomon_difference(a, b);
    r.low = (a - r.high) - b;
    return r;
}

/// c - a b as a double word, for any magnitudes; relative error 2 u^2 of |c| + |a b|.
GNOMON_KERNEL GNOMON_T(double_word) subtract_product(Real c, Real a, Real b)
{
    double_word p = two_product(a, b);
    double_word r = two_difference(c, p.high);
    r.low = r.low - p.low;
    return r;
}

/// The same for |c| >= |a b|; elsewhere low is off by up to a rounding of a b.
GNOMON_KERNEL GNOMON_T(double_word) subtract_product_ordered(Real c, Real a, Real b)
{
    double_word p = two_product(a, b);
    double_word r = two_difference_ordered(c, p.high);
    r.low = r.low - p.low;
    return r;
}

/// c - a b within 2 roundings of its value, whatever cancels: where c and a b do, their difference is exact.
GNOMON_KERNEL Real subtract_product_rounded(Real c, Real a, Real b)
{
    double_word p = two_product(a, b);
    return (c - p.high) - p.low;
}

/// a b - c d within 2 roundings of its value, whatever cancels.
/// Source: Jeannerod, Louvet & Muller 2013, "Further analysis of Kahan's algorithm for the accurate computation of 2x2
/// determinants".
GNOMON_KERNEL Real difference_of_products(Real a, Real b, Real c, Real d)
{
    double_word p = two_product(a, b);
    double_word q = two_product(c, d);
    return (p.high - q.high) + (p.low - q.low);
}

/// a b - c d for double words, as a double word. Error: 2^-40 (|a b| + |c d|) in float, 2^-98 in double, for lows of at
/// most 2^-20 (2^-49) of their highs.
GNOMON_KERNEL GNOMON_T(double_word) double_word_minor(GNOMON_T(double_word) a, GNOMON_T(double_word) b,
                                                      GNOMON_T(double_word) c, GNOMON_T(double_word) d)
{
    double_word p = two_product(a.high, b.high);
    double_word q = two_product(c.high, d.high);
    double_word r = two_difference(p.high, q.high);
    Real cross = (a.high * b.low + a.low * b.high) - (c.high * d.low + c.low * d.high);
    r.low = r.low + ((p.low - q.low) + (cross + (a.low * b.low - c.low * d.low)));
    return r;
}

/// a c - b^2 for double words. Error: two roundings of the result, and as for double_word_minor.
GNOMON_KERNEL Real double_word_determinant(GNOMON_T(double_word) a, GNOMON_T(double_word) b, GNOMON_T(double_word) c)
{
    double_word p = two_product(a.high, c.high);
    double_word q = two_product(b.high, b.high);
    Real cross = (a.high * c.low + a.low * (c.high + c.low)) - b.low * ((b.high + b.high) + b.low);
    return (p.high - q.high) + ((p.low - q.low) + cross);
}

GNOMON_NAMESPACE_END
#endif
