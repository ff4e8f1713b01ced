// Raised pivots: the default bias of four moments once, and a losing variant now. Each pivot D_k of the Hankel matrix
// is raised to at least noise |P_k(i)|^2, about what errors up to noise in each stored moment make of it. That leaks
// less than a constant bias, and darkens lit surfaces by up to 0.79 (docs/decisions/2-bias.md).
#ifndef GNOMON_BENCH_RAISED_PIVOTS4_HPP
#define GNOMON_BENCH_RAISED_PIVOTS4_HPP

#include <gnomon/storage/formats.hpp>

namespace gnomon::bench {

inline constexpr double raised4_unorm16_noise = 9 * 0x1p-20, raised4_half_noise = 9 * 0x1p-16,
                        raised4_float_noise = 3 * 0x1p-26; // of each stored moment

/// Raises D_2, from V, already raised, L and M. On the boundary of valid moments L^2 = V M, so D_1 |P_2(i)|^2, at
/// least V, is computed without a division.
template <class Real>
GNOMON_INLINE constexpr hankel4<Real> hankel4_raised_last(moments4<Real> b, Real v, Real l, Real m, Real noise)
{
    const Real t = b.b2 + Real(1);
    const Real norm = (b.b1 * b.b1 + Real(1)) * m + t * (t * v - (b.b1 + b.b1) * l);
    return hankel4_make(b.b1, v, l, gnomon_max(noise * gnomon_max(v, norm), v * m - l * l));
}

template <class Real> GNOMON_INLINE constexpr hankel4<Real> hankel4_raised(moments4<Real> b, double noise)
{
    const Real least = literal<Real>(noise);
    const Real v = gnomon_max(least * (b.b1 * b.b1 + Real(1)), subtract_product_rounded(b.b2, b.b1, b.b1));
    const Real l = subtract_product_rounded(b.b3, b.b1, b.b2);
    const Real m = subtract_product_rounded(b.b4, b.b2, b.b2);
    return hankel4_raised_last(b, v, l, m, least);
}

/// Raises the pivots in plain arithmetic.
template <class Real> GNOMON_INLINE constexpr hankel4<Real> hankel4_raised_fast(moments4<Real> b, double noise)
{
    const Real least = literal<Real>(noise);
    const Real v = gnomon_max(least * (b.b1 * b.b1 + Real(1)), b.b2 - b.b1 * b.b1);
    return hankel4_raised_last(b, v, b.b3 - b.b1 * b.b2, b.b4 - b.b2 * b.b2, least);
}

template <class Real>
GNOMON_INLINE constexpr hankel4<Real> hankel4_raised_from(const moments4_unorm16&, channels4<Real> c)
{
    return hankel4_raised_fast(theta4_inverse(c), raised4_unorm16_noise);
}
template <class Real> GNOMON_INLINE constexpr hankel4<Real> hankel4_raised_from(const moments4_half&, channels4<Real> c)
{
    return hankel4_raised_fast(theta4_inverse(channels4_shifted(c, literal<Real>(0.5))), raised4_half_noise);
}
template <class Real>
GNOMON_INLINE constexpr hankel4<Real> hankel4_raised_from(const moments4_float&, channels4<Real> c)
{
    return hankel4_raised(moments4_from_channels(c), raised4_float_noise);
}

} // namespace gnomon::bench
#endif
