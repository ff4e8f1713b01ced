// Four moments: the default route, its variants, and Algorithm 1 as printed. Compiled exactly, as the library is meant
// to be, and with contraction.
#include "core/measure.hpp"
#include "evaluation/methods/raised_pivots4.hpp"
#include "moments.hpp"

#include <gnomon/comparators/hamburger_cholesky.h>
#include <gnomon/moments/hamburger4.h>
#include <gnomon/moments/two_point.h>
#include <gnomon/storage/moments4.h>

namespace gnomon::bench::GNOMON_BENCH_ARITHMETIC {

struct moments : moments_and_receiver<4>, compilation {};
struct channels : channels_and_receiver<4>, compilation {};

template <class Real> GNOMON_INLINE constexpr moments4<Real> biased(moments4<Real> b)
{
    return moments4_add_bias(b, literal<Real>(bias4_raw_b2), literal<Real>(bias4_raw_b4),
                             literal<Real>(stored4_float_weight));
}

struct algorithm1 : moments {
    static constexpr auto name = "Algorithm 1";
    static constexpr bool has_error = true;
    template <class Real> static GNOMON_INLINE constexpr Real run(Real b1, Real b2, Real b3, Real b4, Real z_f)
    {
        return hamburger4_cholesky_intensity(biased(moments4<Real>{b1, b2, b3, b4}), z_f);
    }
};

struct certified : moments {
    static constexpr auto name = "default: certified";
    static constexpr bool has_error = true;
    template <class Real> static GNOMON_INLINE constexpr Real run(Real b1, Real b2, Real b3, Real b4, Real z_f)
    {
        return moments4_float_intensity(channels4<Real>{b1, b2, b3, b4}, z_f);
    }
};

struct certified_half : channels {
    static constexpr auto name = "default: certified, 4 x half";
    static constexpr bool has_error = true;
    template <class Real> static GNOMON_INLINE constexpr Real run(Real c1, Real c2, Real c3, Real c4, Real z_f)
    {
        return moments4_half_intensity(channels4_shifted(channels4<Real>{c1, c2, c3, c4}, literal<Real>(-0.5)), z_f);
    }
};

struct certified_unorm16 : channels {
    static constexpr auto name = "default: certified, 4 x UNORM16";
    static constexpr bool has_error = true;
    template <class Real> static GNOMON_INLINE constexpr Real run(Real c1, Real c2, Real c3, Real c4, Real z_f)
    {
        return moments4_unorm16_intensity(channels4<Real>{c1, c2, c3, c4}, z_f);
    }
};

/// A variant that darkens (docs/decisions/2-bias.md).
struct raised : moments {
    static constexpr auto name = "raised pivots";
    static constexpr bool has_error = true;
    template <class Real> static GNOMON_INLINE constexpr Real run(Real b1, Real b2, Real b3, Real b4, Real z_f)
    {
        return hamburger4_lower(hankel4_raised_from(moments4_float{}, channels4<Real>{b1, b2, b3, b4}), z_f);
    }
};

struct apart : moments {
    static constexpr auto name = "constant bias, kept apart";
    static constexpr bool has_error = true;
    template <class Real> static GNOMON_INLINE constexpr Real run(Real b1, Real b2, Real b3, Real b4, Real z_f)
    {
        return hamburger4_lower(hankel4_constant_bias(moments4<Real>{b1, b2, b3, b4}, literal<Real>(bias4_raw_b2),
                                                      literal<Real>(bias4_raw_b4), literal<Real>(stored4_float_weight)),
                                z_f);
    }
};

struct fast : moments {
    static constexpr auto name = "constant bias, interpolated";
    static constexpr bool has_error = true;
    template <class Real> static GNOMON_INLINE constexpr Real run(Real b1, Real b2, Real b3, Real b4, Real z_f)
    {
        return hamburger4_lower(hankel4_from_moments(biased(moments4<Real>{b1, b2, b3, b4})), z_f);
    }
};

struct unorm16 : channels {
    static constexpr auto name = "constant bias, 4 x UNORM16";
    static constexpr bool has_error = true;
    template <class Real> static GNOMON_INLINE constexpr Real run(Real c1, Real c2, Real c3, Real c4, Real z_f)
    {
        return hamburger4_lower(hankel4_from_unorm16(channels4<Real>{c1, c2, c3, c4}), z_f);
    }
};

struct both_bounds : moments {
    static constexpr auto name = "both bounds";
    static constexpr bool has_error = true;
    template <class Real> static GNOMON_INLINE constexpr Real run(Real b1, Real b2, Real b3, Real b4, Real z_f)
    {
        return bounds_intensity(hamburger4_bounds(hankel4_from_float(channels4<Real>{b1, b2, b3, b4}), z_f),
                                literal<Real>(0.5));
    }
};

/// Returns a sum over all results, so that none is optimised away.
struct distribution : moments {
    static constexpr auto name = "distribution";
    template <class Real> static GNOMON_INLINE constexpr Real run(Real b1, Real b2, Real b3, Real b4, Real z_f)
    {
        const auto d = hamburger4_distribution(hankel4_from_float(channels4<Real>{b1, b2, b3, b4}), z_f);
        return (d.depth0 * d.weight0 + d.depth1 * d.weight1) + d.depth2 * d.weight2;
    }
};

struct two_point : moments {
    static constexpr auto name = "Algorithm 2";
    template <class Real> static GNOMON_INLINE constexpr Real run(Real b1, Real b2, Real b3, Real, Real)
    {
        const auto d = two_point_distribution(b1, b2, b3, literal<Real>(two_point_least_variance));
        return d.depth1 * d.weight1 + d.depth2 * d.weight2;
    }
};

struct decode : channels {
    static constexpr auto name = "quantization undone";
    template <class Real> static GNOMON_INLINE constexpr Real run(Real c1, Real c2, Real c3, Real c4, Real)
    {
        const auto b = theta4_inverse(channels4<Real>{c1, c2, c3, c4});
        return (b.b1 + b.b2) + (b.b3 + b.b4);
    }
};

[[maybe_unused]] const bool registered =
    add_kernels<algorithm1, algorithm1, certified, apart, fast, raised, certified_half, certified_unorm16, unorm16,
                both_bounds, distribution, two_point, decode>("four moments");

} // namespace gnomon::bench::GNOMON_BENCH_ARITHMETIC
