// Convolution shadow maps: the storage format as a type.
#ifndef GNOMON_STORAGE_CONVOLUTION_HPP
#define GNOMON_STORAGE_CONVOLUTION_HPP

#include "convolution.h"
#include "format.hpp"

GNOMON_NAMESPACE_BEGIN

/// 256 bits: 32 UNORM8 channels.
struct convolution_unorm8 : stored_texel<convolution_unorm8, unorm_texel<channels32, 8>> {
    static constexpr std::string_view name = "32x8 UNORM", id = "convolution_unorm8";
    static constexpr double darkening = convolution_unorm8_darkening, filtered_darkening = darkening;

    template <class Real> static constexpr channels<Real> from_depth(Real z) { return convolution_unorm8_encode(z); }
    template <class Real> static constexpr Real intensity(const channels<Real>& c, std::type_identity_t<Real> z_f)
    {
        return convolution_unorm8_intensity(c, z_f);
    }
    template <class Real>
    static constexpr Real filtered_intensity(const channels<Real>& c, std::type_identity_t<Real> z_f)
    {
        return convolution_unorm8_intensity(c, z_f);
    }
};
static_assert(storage_format<convolution_unorm8>);

GNOMON_NAMESPACE_END
#endif
