// Absorbance maps of four moments: the storage formats as types. Their texels are summed (passes/blend.hpp) and filtered like
// those of other maps, and cleared to 0. They hold translucent fragments only, so they are no storage_format.
#ifndef GNOMON_STORAGE_ABSORBANCE4_HPP
#define GNOMON_STORAGE_ABSORBANCE4_HPP

#include "absorbance4.h"
#include "format.hpp"

GNOMON_NAMESPACE_BEGIN

/// Functions that every format of an absorbance map has beside those of its texel:
///     from_fragment(z, alpha)      the channels of one fragment
///     transmittance(channels, additions, overestimation, z_f)
// clang-format off
template <class Format> concept absorbance_format = texel_format<Format> && requires(
        float z, double w, const format_channels<Format>& c, const format_channels<Format, double>& d) {
    { Format::from_fragment(z, z) } -> std::same_as<format_channels<Format>>;
    { Format::from_fragment(w, w) } -> std::same_as<format_channels<Format, double>>;
    { Format::transmittance(c, z, z, z) } -> std::same_as<float>;
    { Format::transmittance(d, w, w, w) } -> std::same_as<double>;
};
// clang-format on

/// 80 bits: five half floats.
struct absorbance4_half : zeroed_texel<half_texel<channels5>> {
    static constexpr std::string_view name = "5x16 half", id = "absorbance4_half";

    template <class Real> static constexpr channels<Real> from_fragment(Real z, Real alpha)
    {
        return absorbance4_half_encode(z, alpha);
    }
    template <class Real>
    static constexpr Real transmittance(const channels<Real>& c, std::type_identity_t<Real> additions,
                                        std::type_identity_t<Real> overestimation, std::type_identity_t<Real> z_f)
    {
        return absorbance4_half_transmittance(c, additions, overestimation, z_f);
    }
};
static_assert(absorbance_format<absorbance4_half> && !storage_format<absorbance4_half>);

/// 160 bits: five floats.
struct absorbance4_float : zeroed_texel<float_texel<channels5>> {
    static constexpr std::string_view name = "5x32 float", id = "absorbance4_float";

    template <class Real> static constexpr channels<Real> from_fragment(Real z, Real alpha)
    {
        return absorbance4_float_encode(z, alpha);
    }
    template <class Real>
    static constexpr Real transmittance(const channels<Real>& c, std::type_identity_t<Real> additions,
                                        std::type_identity_t<Real> overestimation, std::type_identity_t<Real> z_f)
    {
        return absorbance4_float_transmittance(c, additions, overestimation, z_f);
    }
};
static_assert(absorbance_format<absorbance4_float> && !storage_format<absorbance4_float>);

GNOMON_NAMESPACE_END
#endif
