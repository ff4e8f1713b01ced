// Six moments: the default route, its variants, and Algorithm 1 as printed. Compiled exactly, as the library is meant
// to be, and with contraction.
#include "core/measure.hpp"
#include "evaluation/methods/raised_pivots6.hpp"
#include "moments.hpp"

#include <gnomon/comparators/hamburger_cholesky.h>
#include <gnomon/moments/hamburger6.h>
#include <gnomon/storage/moments6.h>

namespace gnomon::bench::GNOMON_BENCH_ARITHMETIC {

struct moments : moments_and_receiver<6>, compilation {};
struct channels : channels_and_receiver<6>, compilation {};

template <class Real> GNOMON_INLINE constexpr moments6<Real> biased(moments6<Real> b)
{
    return moments6_add_bias(b, literal<Real>(bias6_raw_b2), literal<Real>(bias6_raw_b4), literal<Real>(bias6_raw_b6),
                             literal<Real>(stored6_float_weight));
}

struct algorithm1 : moments {
    static constexpr auto name = "Algorithm 1";
    static constexpr bool has_error = true;
    template <class Real>
    static GNOMON_INLINE constexpr Real run(Real b1, Real b2, Real b3, Real b4, Real b5, Real b6, Real z_f)
    {
        return hamburger6_cholesky_intensity(biased(moments6<Real>{b1, b2, b3, b4, b5, b6}), z_f);
    }
};

/// The default, with the bias kept apart.
struct standard : moments {
    static constexpr auto name = "default";
    static constexpr bool has_error = true;
    template <class Real>
    static GNOMON_INLINE constexpr Real run(Real b1, Real b2, Real b3, Real b4, Real b5, Real b6, Real z_f)
    {
        return hamburger6_lower(hankel6_from_float(channels6<Real>{b1, b2, b3, b4, b5, b6}), z_f);
    }
};

struct raised : moments {
    static constexpr auto name = "raised pivots, which darken";
    static constexpr bool has_error = true;
    template <class Real>
    static GNOMON_INLINE constexpr Real run(Real b1, Real b2, Real b3, Real b4, Real b5, Real b6, Real z_f)
    {
        const auto h = hankel6_raised(moments6<Real>{b1, b2, b3, b4, b5, b6}, literal<Real>(raised6_float_noise));
        return hamburger6_lower(h, z_f);
    }
};

struct fast : moments {
    static constexpr auto name = "fast: bias interpolated";
    static constexpr bool has_error = true;
    template <class Real>
    static GNOMON_INLINE constexpr Real run(Real b1, Real b2, Real b3, Real b4, Real b5, Real b6, Real z_f)
    {
        return hamburger6_lower(hankel6_from_moments(biased(moments6<Real>{b1, b2, b3, b4, b5, b6})), z_f);
    }
};

struct unorm16 : channels {
    static constexpr auto name = "6 x UNORM16";
    static constexpr bool has_error = true;
    template <class Real>
    static GNOMON_INLINE constexpr Real run(Real c1, Real c2, Real c3, Real c4, Real c5, Real c6, Real z_f)
    {
        return hamburger6_lower(hankel6_from_unorm16(channels6<Real>{c1, c2, c3, c4, c5, c6}), z_f);
    }
};

struct both_bounds : moments {
    static constexpr auto name = "both bounds";
    static constexpr bool has_error = true;
    template <class Real>
    static GNOMON_INLINE constexpr Real run(Real b1, Real b2, Real b3, Real b4, Real b5, Real b6, Real z_f)
    {
        const auto bounds = hamburger6_bounds(hankel6_from_float(channels6<Real>{b1, b2, b3, b4, b5, b6}), z_f);
        return bounds_intensity(bounds, literal<Real>(0.5));
    }
};

/// Returns a sum over all results, so that none is optimised away.
struct distribution : moments {
    static constexpr auto name = "distribution";
    template <class Real>
    static GNOMON_INLINE constexpr Real run(Real b1, Real b2, Real b3, Real b4, Real b5, Real b6, Real z_f)
    {
        const auto d = hamburger6_distribution(hankel6_from_float(channels6<Real>{b1, b2, b3, b4, b5, b6}), z_f);
        return (d.depth0 * d.weight0 + d.depth1 * d.weight1) + (d.depth2 * d.weight2 + d.depth3 * d.weight3);
    }
};

struct decode : channels {
    static constexpr auto name = "quantization undone";
    template <class Real>
    static GNOMON_INLINE constexpr Real run(Real c1, Real c2, Real c3, Real c4, Real c5, Real c6, Real)
    {
        const auto b = theta6_inverse(channels6<Real>{c1, c2, c3, c4, c5, c6});
        return (b.b1 + b.b2) + (b.b3 + b.b4) + (b.b5 + b.b6);
    }
};

[[maybe_unused]] const bool registered =
    add_kernels<algorithm1, algorithm1, standard, raised, fast, unorm16, both_bounds, distribution, decode>(
        "six moments");

} // namespace gnomon::bench::GNOMON_BENCH_ARITHMETIC
