// Exponential variance shadow maps with translucent occluders. The warps of -z are those of z with their exponents swapped,
// so the filter's lower bound has a mirror image.
#pragma once

#include "evaluation/translucent/blended.hpp"
#include "rules.hpp"

namespace gnomon::evaluation {

inline constexpr exponential_variance_settings<double> swapped_exponents(const exponential_variance_half&)
{
    return {exponential_variance_half_exponent, exponential_variance_half_exponent,
            exponential_variance_half_minimum_variance};
}
inline constexpr exponential_variance_settings<double> swapped_exponents(const exponential_variance_float&)
{
    return {exponential_variance_float_negative_exponent, exponential_variance_float_positive_exponent,
            exponential_variance_float_minimum_variance};
}

template <class Format> struct exponential_variance_rule {
    using format = Format;
    template <class Real> using channels = format_channels<Format, Real>;

    template <class Real> static Real lower(const channels<Real>& c, Real, Real z_f)
    {
        return Format::filtered_intensity(c, z_f);
    }
    template <class Real> static hamburger_bounds<Real> bounds(const channels<Real>& c, Real roundings, Real z_f)
    {
        const auto swapped = swapped_exponents(Format{});
        const auto as_real = [](double x) { return literal<Real>(x); };
        const exponential_variance_moments<Real> mirrored{Real(0) - c.c3, c.c4, Real(0) - c.c1, c.c2};
        const exponential_variance_settings<Real> settings{
            as_real(swapped.positive_exponent), as_real(swapped.negative_exponent), as_real(swapped.minimum_variance)};
        return mirrored_bounds(lower(c, roundings, z_f),
                               exponential_variance_intensity(mirrored, Real(0) - z_f, settings));
    }
};

} // namespace gnomon::evaluation
