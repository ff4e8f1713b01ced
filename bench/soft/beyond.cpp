// Soft shadows beyond Peters et al. 2017, from the channels of a table for 784 texels: the bound for depths in [-1, 1] beside
// the default intensity, which is the baseline, and two occluders beside the mean blocker.
#include "core/measure.hpp"
#include "moments/moments.hpp"

#include <gnomon/soft/depth_interval.h>
#include <gnomon/soft/fusion.h>
#include <gnomon/storage/moments4_summed_within.h>

namespace gnomon::bench::GNOMON_BENCH_ARITHMETIC {

struct channels : channels_and_receiver<4>, compilation {};

template <class Real> GNOMON_INLINE constexpr Real most_texels() { return literal<Real>(784); }

struct usual : channels {
    static constexpr auto name = "default: certified";
    static constexpr bool has_error = true;
    template <class Real> static GNOMON_INLINE constexpr Real run(Real c1, Real c2, Real c3, Real c4, Real z_f)
    {
        return moments4_summed_intensity(channels4<Real>{c1, c2, c3, c4}, most_texels<Real>(), z_f);
    }
};

struct constant : channels {
    static constexpr auto name = "constant bias";
    static constexpr bool has_error = true;
    template <class Real> static GNOMON_INLINE constexpr Real run(Real c1, Real c2, Real c3, Real c4, Real z_f)
    {
        return hamburger4_lower(hankel4_from_summed(channels4<Real>{c1, c2, c3, c4}, most_texels<Real>()), z_f);
    }
};

struct within : channels {
    static constexpr auto name = "constant bias, depths in [-1, 1]";
    static constexpr bool has_error = true;
    template <class Real> static GNOMON_INLINE constexpr Real run(Real c1, Real c2, Real c3, Real c4, Real z_f)
    {
        return moments4_summed_intensity_within(channels4<Real>{c1, c2, c3, c4}, most_texels<Real>(), z_f);
    }
};

struct mean_blocker : channels {
    static constexpr auto name = "mean blocker";
    template <class Real> static GNOMON_INLINE constexpr Real run(Real c1, Real c2, Real c3, Real c4, Real z_f)
    {
        return blocker4_depth(hankel4_from_summed(channels4<Real>{c1, c2, c3, c4}, most_texels<Real>()), z_f);
    }
};

/// Returns a sum over all results, so that none is optimised away.
struct two_occluders : channels {
    static constexpr auto name = "two occluders";
    template <class Real> static GNOMON_INLINE constexpr Real run(Real c1, Real c2, Real c3, Real c4, Real z_f)
    {
        const auto h = hankel4_from_summed(channels4<Real>{c1, c2, c3, c4}, most_texels<Real>());
        const auto r = fusion_occluders(hamburger4_distribution(h, z_f));
        return (r.first + r.second) + r.between;
    }
};

/// Least and greatest depth, the receiver, and two biases.
struct decided : channels {
    static constexpr auto name = "decided by depths";
    template <class Real> static GNOMON_INLINE constexpr Real run(Real c1, Real c2, Real c3, Real c4, Real z_f)
    {
        const auto r = depth_interval_shadow(c1, c2, z_f, c3, c4);
        return r.intensity + r.decided;
    }
};

[[maybe_unused]] const bool registered =
    add_kernels<usual, usual, constant, within, mean_blocker, two_occluders, decided>("beyond soft shadows");

} // namespace gnomon::bench::GNOMON_BENCH_ARITHMETIC
