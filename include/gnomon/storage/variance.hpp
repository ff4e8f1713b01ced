// Variance shadow maps: the storage format as a type.
#ifndef GNOMON_STORAGE_VARIANCE_HPP
#define GNOMON_STORAGE_VARIANCE_HPP

#include "format.hpp"
#include "variance.h"

GNOMON_NAMESPACE_BEGIN

/// 32 bits: two UNORM16 channels.
struct variance_unorm16 : stored_texel<variance_unorm16, unorm_texel<channels2, 16>> {
    static constexpr std::string_view name = "2x16 UNORM", id = "variance_unorm16";
    static constexpr double darkening = variance_unorm16_darkening, filtered_darkening = darkening;

    template <class Real> static constexpr channels<Real> from_depth(Real z) { return variance_unorm16_encode(z); }
    template <class Real> static constexpr Real intensity(const channels<Real>& c, std::type_identity_t<Real> z_f)
    {
        return variance_unorm16_intensity(c, z_f);
    }
    template <class Real>
    static constexpr Real filtered_intensity(const channels<Real>& c, std::type_identity_t<Real> z_f)
    {
        return variance_unorm16_intensity(c, z_f);
    }
};
static_assert(storage_format<variance_unorm16>);

GNOMON_NAMESPACE_END
#endif
