// Exponential shadow maps: the storage format as a type.
#ifndef GNOMON_STORAGE_EXPONENTIAL_HPP
#define GNOMON_STORAGE_EXPONENTIAL_HPP

#include "exponential.h"
#include "format.hpp"

GNOMON_NAMESPACE_BEGIN

/// 32 bits: one float.
struct exponential_float : stored_texel<exponential_float, float_texel<channels1>> {
    static constexpr std::string_view name = "1x32 float", id = "exponential_float";
    static constexpr double darkening = exponential_float_darkening, filtered_darkening = darkening;

    template <class Real> static constexpr channels<Real> from_depth(Real z) { return exponential_float_encode(z); }
    template <class Real> static constexpr Real intensity(const channels<Real>& c, std::type_identity_t<Real> z_f)
    {
        return exponential_float_intensity(c, z_f);
    }
    template <class Real>
    static constexpr Real filtered_intensity(const channels<Real>& c, std::type_identity_t<Real> z_f)
    {
        return exponential_float_intensity(c, z_f);
    }
};
static_assert(storage_format<exponential_float>);

GNOMON_NAMESPACE_END
#endif
