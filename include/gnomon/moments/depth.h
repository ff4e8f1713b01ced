// Signed depth from what depth buffers hold. Signed depth is -1 at the near plane, +1 at the far plane, and linear in the
// view distance: filters need the linearity, since they average depths. A perspective projection is not linear, so its
// buffer needs a conversion of its own.
//
//   buffer                                    near plane   far plane    conversion
//   view distance                             near         far          depth_from_distance
//   orthographic, or linear                   0            1            depth_from_unit
//   orthographic, or linear, reversed         1            0            depth_from_reversed
//   perspective                               0            1            depth_from_perspective
//   perspective, reversed                     1            0            depth_from_reversed_perspective
//   perspective, infinite far plane           0            (1)          depth_from_infinite
//   perspective, infinite, reversed           1            (0)          depth_from_reversed_infinite
//
// A buffer in [-1, 1], as in OpenGL, first becomes 0.5 z + 0.5.
#ifndef GNOMON_MOMENTS_DEPTH_H
#define GNOMON_MOMENTS_DEPTH_H
#include "../numerics/select.h"
GNOMON_NAMESPACE_BEGIN

/// Signed depth from a linear buffer: z is 0 at the near plane and 1 at the far plane. For an orthographic projection or a
/// stored linear depth alone: the buffer of a perspective projection needs depth_from_perspective.
/// Domain: z in [0, 1].
/// NaN: NaN.
/// Error: one rounding.
GNOMON_KERNEL Real depth_from_unit(Real z) { return z * Real(2) - Real(1); }

/// Signed depth from a reversed linear buffer: z is 1 at the near plane and 0 at the far plane. The buffer of a
/// perspective projection needs depth_from_reversed_perspective.
/// Domain: z in [0, 1].
/// NaN: NaN.
/// Error: one rounding.
GNOMON_KERNEL Real depth_from_reversed(Real z) { return Real(1) - z * Real(2); }

/// Signed depth of a view distance: -1 at near_distance, +1 at far_distance, in any unit.
/// Domain: near_distance < far_distance. Equal planes give infinities before and behind them, NaN on them, which encoders
/// store as the near and the far plane.
/// NaN: NaN.
/// Error: 5 2^-p for distances between the planes.
GNOMON_KERNEL Real depth_from_distance(Real distance_, GNOMON_SETTING near_distance, GNOMON_SETTING far_distance)
{
    return ((distance_ - near_distance) - (far_distance - distance_)) / (far_distance - near_distance);
}

/// The signed depth (n - f) / (n + f) of a point whose distances to the planes are as n to f, near to far.
GNOMON_DETAIL_KERNEL Real depth_between(Real n, Real f) { return (n - f) / (n + f); }

/// Signed depth from the buffer of a perspective projection: z is 0 at near_distance and 1 at far_distance.
/// Domain: any z, limited to [0, 1]; 0 < near_distance < far_distance < infinity. Elsewhere a finite number, infinity or NaN,
/// which encoders limit.
/// NaN: NaN.
/// Error: 4 2^-p, where the buffer itself is exact.
GNOMON_KERNEL Real depth_from_perspective(Real z, GNOMON_SETTING near_distance, GNOMON_SETTING far_distance)
{
    Real x = clamp_or_nan(z, Real(0), Real(1));
    return depth_between(near_distance * x, far_distance * (Real(1) - x));
}

/// Signed depth from the reversed buffer of a perspective projection: z is 1 at near_distance and 0 at far_distance.
/// Domain: any z, limited to [0, 1]; 0 < near_distance < far_distance < infinity. Elsewhere a finite number, infinity or NaN,
/// which encoders limit.
/// NaN: NaN.
/// Error: 4 2^-p, where the buffer itself is exact.
GNOMON_KERNEL Real depth_from_reversed_perspective(Real z, GNOMON_SETTING near_distance, GNOMON_SETTING far_distance)
{
    Real x = clamp_or_nan(z, Real(0), Real(1));
    return depth_between(near_distance * (Real(1) - x), far_distance * x);
}

/// Signed depth from the reversed buffer of a perspective projection without far plane: z = near_distance / distance. Of
/// signed depth far_distance is the far plane. Farther points are on it.
/// Domain: any z, limited to [0, 1]; 0 < near_distance, 2 near_distance <= far_distance < infinity. Elsewhere a
/// number in [-1, 1] or NaN.
/// NaN: NaN.
/// Error: 8 2^-p, where the buffer itself is exact.
GNOMON_KERNEL Real depth_from_reversed_infinite(Real z, GNOMON_SETTING near_distance, GNOMON_SETTING far_distance)
{
    Real x = gnomon_abs(clamp_or_nan(z, Real(0), Real(1))); // -0 is the far plane, too
    Real depth =
        (near_distance * (Real(1) - x) - (far_distance * x - near_distance)) / (x * (far_distance - near_distance));
    return clamp_or_nan(depth, Real(-1), Real(1));
}

/// Signed depth from the buffer of a perspective projection without far plane: z = 1 - near_distance / distance. Of signed
/// depth far_distance is the far plane. Farther points are on it.
/// Domain: any z, limited to [0, 1]; 0 < near_distance, 2 near_distance <= far_distance < infinity. Elsewhere a
/// number in [-1, 1] or NaN.
/// NaN: NaN.
/// Error: 8 2^-p, where 1 - z is exact.
GNOMON_KERNEL Real depth_from_infinite(Real z, GNOMON_SETTING near_distance, GNOMON_SETTING far_distance)
{
    return depth_from_reversed_infinite(Real(1) - z, near_distance, far_distance);
}

GNOMON_NAMESPACE_END
#endif
