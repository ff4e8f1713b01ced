// Four moments in a summed-area table: the table as a type.
#ifndef GNOMON_STORAGE_MOMENTS4_SUMMED_HPP
#define GNOMON_STORAGE_MOMENTS4_SUMMED_HPP

#include "moments4_summed.h"
#include "summed_texel.hpp"

GNOMON_NAMESPACE_BEGIN

/// 128 bits: sums of four channels after theta4.
struct moments4_summed : summed_texel<channels4> {
    static constexpr std::string_view name = "4x32 summed", id = "moments4_summed";
    static constexpr double darkening([[maybe_unused]] double most_texels) { return stored4_arithmetic_weight; }

    /// The channels of one depth. In double the plain transform errs by far less than a code.
    template <class Real> static constexpr channels<Real> from_depth(Real z)
    {
        if constexpr (std::is_same_v<Real, double>) return moments4_unorm16_encode(z);
        else return moments4_summed_encode(z);
    }
    /// The mean channels of depth samples: moments are averaged before the transform, which is linear.
    template <std::size_t samples>
    static constexpr channels<double> from_samples(const std::array<float, samples>& depths)
    {
        constexpr double share = 1.0 / double(samples);
        moments4<double> sum{};
        for (const float z : depths)
            sum = moments4_add(sum, moments4_from_depth(clamp_or_high(double(z), -1.0, 1.0)), share);
        return theta4(sum);
    }
    template <class Real>
    static constexpr channels<Real> codes(const channels<Real>& c, std::type_identity_t<Real> scale)
    {
        return moments4_summed_codes(c, scale);
    }
    template <class Real>
    static constexpr channels<Real> mean(const channels<Real>& sums, std::type_identity_t<Real> area,
                                         std::type_identity_t<Real> scale)
    {
        return moments4_summed_channels(sums, area, scale);
    }
    template <class Real>
    static constexpr Real intensity(const channels<Real>& c, std::type_identity_t<Real> most_texels,
                                    std::type_identity_t<Real> z_f)
    {
        return moments4_summed_intensity(c, most_texels, z_f);
    }
    template <class Real>
    static constexpr Real blocker(const channels<Real>& c, std::type_identity_t<Real> most_texels,
                                  std::type_identity_t<Real> z_f)
    {
        return moments4_summed_blocker(c, most_texels, z_f);
    }
    template <class Real>
    static constexpr hankel4<Real> factor(const channels<Real>& c, std::type_identity_t<Real> most_texels)
    {
        return hankel4_from_summed(c, most_texels);
    }
};
static_assert(summed_table<moments4_summed> && !storage_format<moments4_summed>);

GNOMON_NAMESPACE_END
#endif
