// Far planes of cameras in light axes, for tests of single scattering.
#pragma once

#include "hostile.hpp"

#include <gnomon/scattering/rectified_frustum.h>

#include <array>
#include <cmath>

namespace gnomon::test {

/// The corners of the far plane of a camera: right, up and forward are orthonormal, half widths are tangents.
template <class T>
rectified_corners<T> far_plane(const std::array<std::array<double, 3>, 3>& axes, double across, double along,
                               double reach)
{
    const auto corner = [&](double i, double j) {
        const auto at = [&](std::size_t k) {
            return T(reach * (i * across * axes[0][k] + j * along * axes[1][k] + axes[2][k]));
        };
        return rectified_corner<T>{at(0), at(1), at(2)};
    };
    return {corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)};
}

/// The axes of a camera that looks along the unit vector whose z is given, at an azimuth, and is turned about it by roll.
inline std::array<std::array<double, 3>, 3> camera_axes(double z, double azimuth, double roll)
{
    const double r = std::sqrt(1 - z * z), ca = std::cos(azimuth), sa = std::sin(azimuth);
    const double cr = std::cos(roll), sr = std::sin(roll);
    const std::array<double, 3> forward{r * ca, r * sa, z}, side{-sa, ca, 0}, down{z * ca, z * sa, -r};
    std::array<std::array<double, 3>, 3> axes{};
    for (std::size_t k = 0; k < 3; ++k) {
        axes[0][k] = cr * side[k] + sr * down[k];
        axes[1][k] = cr * down[k] - sr * side[k];
        axes[2][k] = forward[k];
    }
    return axes;
}

/// The far plane of a camera that looks anywhere; sometimes along the light, or with a corner or an edge on the axis.
template <class T> rectified_corners<T> any_far_plane(bit_source& bits)
{
    constexpr double pi = 3.14159265358979324;
    const double reach = std::exp2(bits.uniform(-6, 8));
    if (bits.chance(0.1)) { // along an axis, and coordinates that are exact
        const T s = T(reach), z = bits.chance(0.5) ? s : -s, o = T(double(bits.below(3)) - 1);
        return {{o * s, o * s, z}, {(o + 1) * s, o * s, z}, {(o + 1) * s, (o + 1) * s, z}, {o * s, (o + 1) * s, z}};
    }
    const double z = bits.chance(0.1) ? (bits.chance(0.5) ? 1 : -1) : bits.uniform(-1, 1);
    const double azimuth = bits.uniform(-pi, pi), roll = bits.uniform(-pi, pi);
    const double along = std::tan(bits.uniform(0.02, 1.2)), across = along * bits.uniform(0.5, 2.4);
    return far_plane<T>(camera_axes(z, azimuth, roll), across, along, reach);
}

} // namespace gnomon::test
