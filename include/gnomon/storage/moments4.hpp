// Shadow maps of four moments: the storage formats as types.
//
// Beside what every format has: from_moments transforms moments, and to_moments transforms back; factor and filtered_factor give the matrix with a
// constant bias, of the vector bias and the weight bias_weight or filtered_bias_weight, for both bounds.
#ifndef GNOMON_STORAGE_MOMENTS4_HPP
#define GNOMON_STORAGE_MOMENTS4_HPP

#include "../moments/hamburger4.h"
#include "format.hpp"
#include "moments4.h"
#include "moments4_blended.h"

GNOMON_NAMESPACE_BEGIN

/// 64 bits: four UNORM16 channels after theta4.
struct moments4_unorm16 : stored_texel<moments4_unorm16, unorm_texel<channels4, 16>> {
    static constexpr std::string_view name = "4x16 UNORM", id = "moments4_unorm16";
    static constexpr double darkening = stored4_arithmetic_weight, filtered_darkening = stored4_arithmetic_weight;

    template <class Real> static constexpr channels<Real> from_depth(Real z) { return moments4_unorm16_encode(z); }
    template <class Real> static constexpr Real intensity(const channels<Real>& c, std::type_identity_t<Real> z_f)
    {
        return moments4_unorm16_intensity(c, z_f);
    }
    template <class Real>
    static constexpr Real filtered_intensity(const channels<Real>& c, std::type_identity_t<Real> z_f)
    {
        return moments4_unorm16_filtered_intensity(c, z_f);
    }

    static constexpr std::array<double, 2> bias = {bias4_theta_b2, bias4_theta_b4};
    static constexpr double bias_weight = stored4_unorm16_weight,
                            filtered_bias_weight = stored4_unorm16_filtered_weight;

    template <class Real> static constexpr channels<Real> from_moments(const moments4<Real>& b) { return theta4(b); }
    template <class Real> static constexpr moments4<Real> to_moments(const channels<Real>& c)
    {
        return theta4_inverse(c);
    }
    template <class Real> static constexpr hankel4<Real> factor(const channels<Real>& c)
    {
        return hankel4_from_unorm16(c);
    }
    template <class Real> static constexpr hankel4<Real> filtered_factor(const channels<Real>& c)
    {
        return hankel4_from_unorm16_filtered(c);
    }

    template <class Real>
    static constexpr Real blended_intensity(const channels<Real>& c, std::type_identity_t<Real> roundings,
                                            std::type_identity_t<Real> z_f)
    {
        return moments4_unorm16_blended_intensity(c, roundings, z_f);
    }
    template <class Real>
    static constexpr hankel4<Real> blended_factor(const channels<Real>& c, std::type_identity_t<Real> roundings)
    {
        return hankel4_from_unorm16_blended(c, roundings);
    }
};
static_assert(storage_format<moments4_unorm16>);

/// 64 bits: four half floats of theta4 less 1/2.
struct moments4_half : stored_texel<moments4_half, half_texel<channels4>> {
    static constexpr std::string_view name = "4x16 half", id = "moments4_half";
    static constexpr double darkening = stored4_arithmetic_weight, filtered_darkening = stored4_arithmetic_weight;

    template <class Real> static constexpr channels<Real> from_depth(Real z) { return moments4_half_encode(z); }
    template <class Real> static constexpr Real intensity(const channels<Real>& c, std::type_identity_t<Real> z_f)
    {
        return moments4_half_intensity(c, z_f);
    }
    template <class Real>
    static constexpr Real filtered_intensity(const channels<Real>& c, std::type_identity_t<Real> z_f)
    {
        return moments4_half_filtered_intensity(c, z_f);
    }

    static constexpr std::array<double, 2> bias = {bias4_theta_b2, bias4_theta_b4};
    static constexpr double bias_weight = stored4_half_weight, filtered_bias_weight = stored4_half_filtered_weight;

    template <class Real> static constexpr channels<Real> from_moments(const moments4<Real>& b)
    {
        return channels4_shifted(theta4(b), Real(-0.5));
    }
    template <class Real> static constexpr moments4<Real> to_moments(const channels<Real>& c)
    {
        return theta4_inverse(channels4_shifted(c, Real(0.5)));
    }
    template <class Real> static constexpr hankel4<Real> factor(const channels<Real>& c)
    {
        return hankel4_from_half(c);
    }
    template <class Real> static constexpr hankel4<Real> filtered_factor(const channels<Real>& c)
    {
        return hankel4_from_half_filtered(c);
    }

    template <class Real>
    static constexpr Real blended_intensity(const channels<Real>& c, std::type_identity_t<Real> roundings,
                                            std::type_identity_t<Real> z_f)
    {
        return moments4_half_blended_intensity(c, roundings, z_f);
    }
    template <class Real>
    static constexpr hankel4<Real> blended_factor(const channels<Real>& c, std::type_identity_t<Real> roundings)
    {
        return hankel4_from_half_blended(c, roundings);
    }
};
static_assert(storage_format<moments4_half>);

/// 128 bits: four floats.
struct moments4_float : stored_texel<moments4_float, float_texel<channels4>> {
    static constexpr std::string_view name = "4x32 float", id = "moments4_float";
    static constexpr double darkening = stored4_arithmetic_weight, filtered_darkening = stored4_arithmetic_weight;

    template <class Real> static constexpr channels<Real> from_depth(Real z) { return moments4_float_encode(z); }
    template <class Real> static constexpr Real intensity(const channels<Real>& c, std::type_identity_t<Real> z_f)
    {
        return moments4_float_intensity(c, z_f);
    }
    template <class Real>
    static constexpr Real filtered_intensity(const channels<Real>& c, std::type_identity_t<Real> z_f)
    {
        return moments4_float_filtered_intensity(c, z_f);
    }

    static constexpr std::array<double, 2> bias = {bias4_raw_b2, bias4_raw_b4};
    static constexpr double bias_weight = stored4_float_weight, filtered_bias_weight = stored4_float_filtered_weight;

    template <class Real> static constexpr channels<Real> from_moments(const moments4<Real>& b)
    {
        return channels4_from_moments(b);
    }
    template <class Real> static constexpr moments4<Real> to_moments(const channels<Real>& c)
    {
        return moments4_from_channels(c);
    }
    template <class Real> static constexpr hankel4<Real> factor(const channels<Real>& c)
    {
        return hankel4_from_float(c);
    }
    template <class Real> static constexpr hankel4<Real> filtered_factor(const channels<Real>& c)
    {
        return hankel4_from_float_filtered(c);
    }

    template <class Real>
    static constexpr Real blended_intensity(const channels<Real>& c, std::type_identity_t<Real> roundings,
                                            std::type_identity_t<Real> z_f)
    {
        return moments4_float_blended_intensity(c, roundings, z_f);
    }
    template <class Real>
    static constexpr hankel4<Real> blended_factor(const channels<Real>& c, std::type_identity_t<Real> roundings)
    {
        return hankel4_from_float_blended(c, roundings);
    }
};
static_assert(storage_format<moments4_float>);

GNOMON_NAMESPACE_END
#endif
