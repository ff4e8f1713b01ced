// Mean and mean square in a summed-area table: the table as a type.
#ifndef GNOMON_STORAGE_VARIANCE_SUMMED_HPP
#define GNOMON_STORAGE_VARIANCE_SUMMED_HPP

#include "summed_texel.hpp"
#include "variance_summed.h"

GNOMON_NAMESPACE_BEGIN

/// 64 bits: sums of the mean and the mean square.
struct variance_summed : summed_texel<channels2> {
    static constexpr std::string_view name = "2x32 summed", id = "variance_summed";
    static constexpr double darkening([[maybe_unused]] double most_texels) { return variance_summed_darkening; }

    template <class Real> static constexpr channels<Real> from_depth(Real z) { return variance_summed_encode(z); }
    /// The mean channels of depth samples.
    template <std::size_t samples>
    static constexpr channels<double> from_samples(const std::array<float, samples>& depths)
    {
        constexpr double share = 1.0 / double(samples);
        channels<double> sum{};
        for (const float z : depths) {
            const channels<double> c = variance_summed_encode(double(z));
            sum.c1 += share * c.c1;
            sum.c2 += share * c.c2;
        }
        return sum;
    }
    template <class Real>
    static constexpr channels<Real> codes(const channels<Real>& c, std::type_identity_t<Real> scale)
    {
        return variance_summed_codes(c, scale);
    }
    template <class Real>
    static constexpr channels<Real> mean(const channels<Real>& sums, std::type_identity_t<Real> area,
                                         std::type_identity_t<Real> scale)
    {
        return variance_summed_channels(sums, area, scale);
    }
    template <class Real>
    static constexpr Real intensity(const channels<Real>& c, std::type_identity_t<Real> most_texels,
                                    std::type_identity_t<Real> z_f)
    {
        return variance_summed_intensity(c, most_texels, z_f);
    }
    template <class Real>
    static constexpr Real blocker(const channels<Real>& c, std::type_identity_t<Real> most_texels,
                                  std::type_identity_t<Real> z_f)
    {
        return variance_summed_blocker(c, most_texels, z_f);
    }
};
static_assert(summed_table<variance_summed> && !storage_format<variance_summed>);

GNOMON_NAMESPACE_END
#endif
