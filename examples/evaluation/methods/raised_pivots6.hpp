// A losing variant, kept to be measured: raised pivots for six moments. Each pivot D_k of the moments as they are is
// raised to at least noise |P_k(i)|^2, about what errors up to noise in each stored moment make of it. It leaks less
// than a constant bias, and it darkens lit surfaces: a raised D_2 changes P_3, and no distribution near has such
// moments, so that it fails on exact moments in double. Depths -0.0004 and 0.0008 with half the weight each, receiver
// on the second: 0.666, where 0.5 is the truth.
#ifndef GNOMON_BENCH_RAISED_PIVOTS6_HPP
#define GNOMON_BENCH_RAISED_PIVOTS6_HPP

#include <gnomon/moments/hankel6.h>

namespace gnomon::bench {

inline constexpr double raised6_float_noise = 0x3p-23;

/// |P_k(i)|^2 from its two parts; at least 1, since the roots of P_k are real. A NaN stays one.
template <class Real> GNOMON_INLINE constexpr Real raised6_norm(Real x, Real y)
{
    return gnomon_max(Real(1), x * x + y * y);
}

template <class Real> GNOMON_INLINE constexpr hankel6<Real> hankel6_raised(moments6<Real> b, Real noise)
{
    hankel6<Real> h;
    h.mean = b.b1;
    h.variance = gnomon_max(noise * (b.b1 * b.b1 + Real(1)), subtract_product_rounded(b.b2, b.b1, b.b1));
    const Real inverse1 = Real(1) / h.variance;
    const Real c12 = subtract_product_rounded(b.b3, b.b1, b.b2);
    const Real c13 = subtract_product_rounded(b.b4, b.b1, b.b3);
    const Real l21 = c12 * inverse1;
    const Real l31 = c13 * inverse1;
    const Real p0 = l21 * b.b1 - b.b2; // P_2 = z^2 - l21 z + p0
    const Real d2 =
        gnomon_max(noise * raised6_norm(l21, p0 - Real(1)), subtract_product_rounded(b.b4, b.b2, b.b2) - l21 * c12);
    const Real inverse2 = Real(1) / d2;
    h.ratio = d2 * inverse1;
    const Real c23 = subtract_product_rounded(b.b5, b.b2, b.b3) - l21 * c13;
    const Real l32 = c23 * inverse2;
    h.shift2 = l21 - Real(2) * b.b1;
    h.shift3 = (l32 - l21) - b.b1;
    const Real q1 = l32 * l21 - l31; // P_3 = z^3 - l32 z^2 + q1 z + q0
    const Real q0 = (l31 * b.b1 - b.b3) - l32 * p0;
    const Real d3 = (subtract_product_rounded(b.b6, b.b3, b.b3) - l31 * c13) - l32 * c23;
    h.whole = gnomon_max(noise * raised6_norm(l32 + q0, q1 - Real(1)), d3);
    h.first = h.whole * inverse1;
    h.second = h.whole * inverse2;
    return h;
}

} // namespace gnomon::bench
#endif
