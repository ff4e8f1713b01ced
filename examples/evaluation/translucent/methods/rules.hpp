// Rules of maps that translucent fragments are blended into (../blended.hpp).
#pragma once

#include <gnomon/moments/hamburger4.h>
#include <gnomon/moments/hamburger6.h>
#include <gnomon/storage/formats.hpp>

namespace gnomon::evaluation {

// Bounds where the upper one is the mirror image of a lower one: that of the distribution of -z at -z_f.
template <class Real> hamburger_bounds<Real> mirrored_bounds(Real lower, Real mirrored_lower)
{
    const Real weight = gnomon_max(Real(0), (Real(1) - mirrored_lower) - lower);
    return {lower, lower + weight, weight};
}

template <class Real> hamburger_bounds<Real> bounds_of(const hankel4<Real>& b, Real z_f)
{
    return hamburger4_bounds(b, z_f);
}
template <class Real> hamburger_bounds<Real> bounds_of(const hankel6<Real>& b, Real z_f)
{
    return hamburger6_bounds(b, z_f);
}

// Moments with noise and bias that allow for the roundings of all blends.
template <class Format> struct moments_rule {
    using format = Format;
    template <class Real> using channels = format_channels<Format, Real>;

    template <class Real> static Real lower(const channels<Real>& c, Real roundings, Real z_f)
    {
        return Format::blended_intensity(c, roundings, z_f);
    }
    template <class Real> static hamburger_bounds<Real> bounds(const channels<Real>& c, Real roundings, Real z_f)
    {
        return bounds_of(Format::blended_factor(c, roundings), z_f);
    }
};

} // namespace gnomon::evaluation
