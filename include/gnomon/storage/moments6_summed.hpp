// Six moments in a summed-area table: the table as a type.
#ifndef GNOMON_STORAGE_MOMENTS6_SUMMED_HPP
#define GNOMON_STORAGE_MOMENTS6_SUMMED_HPP

#include "moments6_summed.h"
#include "summed_texel.hpp"

GNOMON_NAMESPACE_BEGIN

/// 192 bits: sums of six channels after theta6.
struct moments6_summed : summed_texel<channels6> {
    static constexpr std::string_view name = "6x32 summed", id = "moments6_summed";
    static constexpr double darkening(double most_texels) { return moments6_summed_weight(most_texels); }

    template <class Real> static constexpr channels<Real> from_depth(Real z) { return moments6_summed_encode(z); }
    /// The mean channels of depth samples: moments are averaged before the transform, which is linear.
    template <std::size_t samples>
    static constexpr channels<double> from_samples(const std::array<float, samples>& depths)
    {
        constexpr double share = 1.0 / double(samples);
        moments6<double> sum{};
        for (const float z : depths)
            sum = moments6_add(sum, moments6_from_depth(clamp_or_high(double(z), -1.0, 1.0)), share);
        return theta6(sum);
    }
    template <class Real>
    static constexpr channels<Real> codes(const channels<Real>& c, std::type_identity_t<Real> scale)
    {
        return moments6_summed_codes(c, scale);
    }
    template <class Real>
    static constexpr channels<Real> mean(const channels<Real>& sums, std::type_identity_t<Real> area,
                                         std::type_identity_t<Real> scale)
    {
        return moments6_summed_channels(sums, area, scale);
    }
    template <class Real>
    static constexpr Real intensity(const channels<Real>& c, std::type_identity_t<Real> most_texels,
                                    std::type_identity_t<Real> z_f)
    {
        return moments6_summed_intensity(c, most_texels, z_f);
    }
    template <class Real>
    static constexpr Real blocker(const channels<Real>& c, std::type_identity_t<Real> most_texels,
                                  std::type_identity_t<Real> z_f)
    {
        return moments6_summed_blocker(c, most_texels, z_f);
    }
    template <class Real>
    static constexpr hankel6<Real> factor(const channels<Real>& c, std::type_identity_t<Real> most_texels)
    {
        return hankel6_from_summed(c, most_texels);
    }
};
static_assert(summed_table<moments6_summed> && !storage_format<moments6_summed>);

GNOMON_NAMESPACE_END
#endif
