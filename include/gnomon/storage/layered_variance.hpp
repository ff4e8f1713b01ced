// Layered variance shadow maps: the storage format as a type.
#ifndef GNOMON_STORAGE_LAYERED_VARIANCE_HPP
#define GNOMON_STORAGE_LAYERED_VARIANCE_HPP

#include "format.hpp"
#include "layered_variance.h"

GNOMON_NAMESPACE_BEGIN

/// 128 bits: four layers, each of two UNORM16 channels.
struct layered_variance_unorm16 : stored_texel<layered_variance_unorm16, unorm_texel<channels8, 16>> {
    static constexpr std::string_view name = "8x16 UNORM", id = "layered_variance_unorm16";
    static constexpr double darkening = layered_variance_unorm16_darkening, filtered_darkening = darkening;

    template <class Real> static constexpr channels<Real> from_depth(Real z)
    {
        return layered_variance_unorm16_encode(z);
    }
    template <class Real> static constexpr Real intensity(const channels<Real>& c, std::type_identity_t<Real> z_f)
    {
        return layered_variance_unorm16_intensity(c, z_f);
    }
    template <class Real>
    static constexpr Real filtered_intensity(const channels<Real>& c, std::type_identity_t<Real> z_f)
    {
        return layered_variance_unorm16_intensity(c, z_f);
    }
};
static_assert(storage_format<layered_variance_unorm16>);

GNOMON_NAMESPACE_END
#endif
