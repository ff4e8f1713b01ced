// Exponential variance shadow maps: the storage formats as types.
#ifndef GNOMON_STORAGE_EXPONENTIAL_VARIANCE_HPP
#define GNOMON_STORAGE_EXPONENTIAL_VARIANCE_HPP

#include "exponential_variance.h"
#include "format.hpp"

GNOMON_NAMESPACE_BEGIN

/// 64 bits: four half floats.
struct exponential_variance_half : stored_texel<exponential_variance_half, half_texel<channels4>> {
    static constexpr std::string_view name = "4x16 half", id = "exponential_variance_half";
    static constexpr double darkening = exponential_variance_half_darkening, filtered_darkening = darkening;

    template <class Real> static constexpr channels<Real> from_depth(Real z)
    {
        return exponential_variance_half_encode(z);
    }
    template <class Real> static constexpr Real intensity(const channels<Real>& c, std::type_identity_t<Real> z_f)
    {
        return exponential_variance_half_intensity(c, z_f);
    }
    template <class Real>
    static constexpr Real filtered_intensity(const channels<Real>& c, std::type_identity_t<Real> z_f)
    {
        return exponential_variance_half_intensity(c, z_f);
    }
};
static_assert(storage_format<exponential_variance_half>);

/// 128 bits: four floats.
struct exponential_variance_float : stored_texel<exponential_variance_float, float_texel<channels4>> {
    static constexpr std::string_view name = "4x32 float", id = "exponential_variance_float";
    static constexpr double darkening = exponential_variance_float_darkening, filtered_darkening = darkening;

    template <class Real> static constexpr channels<Real> from_depth(Real z)
    {
        return exponential_variance_float_encode(z);
    }
    template <class Real> static constexpr Real intensity(const channels<Real>& c, std::type_identity_t<Real> z_f)
    {
        return exponential_variance_float_intensity(c, z_f);
    }
    template <class Real>
    static constexpr Real filtered_intensity(const channels<Real>& c, std::type_identity_t<Real> z_f)
    {
        return exponential_variance_float_intensity(c, z_f);
    }
};
static_assert(storage_format<exponential_variance_float>);

GNOMON_NAMESPACE_END
#endif
