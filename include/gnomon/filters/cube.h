// Shadow maps of a point light on the six faces of a cube, with the faces, axes and orientations of OpenGL, Vulkan and
// Direct3D: faces 0 to 5 look along +x, -x, +y, -y, +z, -z, and texture coordinates (u, v) lie in [0, 1].
//
// Store signed depth of the distance along the face's axis, cube_position.distance, which is the largest of |x|, |y|, |z|, or
// of the distance to the light. Both are continuous over the edges of the cube, so maps may be blurred and looked up across
// them. A face unfolds over its edge: texels beyond the edge are those of the neighbour, in order, so that cube_direction of
// the centre of a texel beyond the edge leads to the centre of a texel there. A cube sampler reads it as it is:
//
//     direction = cube_direction(face, u + k / size, v);       tap k of a blur along u, 0 <= u <= 1
//
// A quarter around each corner of the cube is missing, and the taps that would lie there go to the edge between the two
// neighbours. Every result is a mean of texels, so bounds stay honest there, too. passes/cube.hpp has blur and look-up in
// main memory.
#ifndef GNOMON_FILTERS_CUBE_H
#define GNOMON_FILTERS_CUBE_H
#include "../numerics/select.h"
GNOMON_NAMESPACE_BEGIN

/// A face, texture coordinates on it, and the distance from the centre along the face's axis.
GNOMON_STRUCT(cube_position) { Real face, u, v, distance; };

/// A direction from the centre of the cube, of any length.
GNOMON_STRUCT(cube_vector) { Real x, y, z; };

/// The face that a direction from the light points to, with the place on it. Among equal coordinates z has precedence over y,
/// and y over x.
/// Domain: any finite direction; for the zero vector the middle of face 4, at distance 0.
/// NaN: some face and some place on it.
/// Error: u and v 2 2^-p, distance none.
GNOMON_KERNEL GNOMON_T(cube_position) cube_position_from_direction(Real x, Real y, Real z)
{
    Real ax = gnomon_abs(x);
    Real ay = gnomon_abs(y);
    Real az = gnomon_abs(z);
    GNOMON_MASK along_z = ax <= az && ay <= az;
    GNOMON_MASK along_y = ax <= ay && !along_z;
    Real major = gnomon_select(along_z, z, gnomon_select(along_y, y, x));
    GNOMON_MASK backward = major < Real(0);
    Real sign = gnomon_select(backward, Real(-1), Real(1));
    Real across = gnomon_select(along_z, sign * x, gnomon_select(along_y, x, Real(-1) * sign * z));
    Real down = gnomon_select(along_y, sign * z, Real(-1) * y);
    GNOMON_T(cube_position) r;
    r.distance = gnomon_abs(major);
    r.face = gnomon_select(along_z, Real(4), gnomon_select(along_y, Real(2), Real(0))) +
             gnomon_select(backward, Real(1), Real(0));
    Real divisor = gnomon_select(Real(0) < r.distance, r.distance, Real(1));
    r.u = clamp_or_high(Real(0.5) * (across / divisor) + Real(0.5), Real(0), Real(1));
    r.v = clamp_or_high(Real(0.5) * (down / divisor) + Real(0.5), Real(0), Real(1));
    return r;
}

/// The direction to a place on a face. Beyond an edge, by less than the face's extent, the place lies on the face folded over
/// that edge.
/// Domain: face 0, 1, ..., 5; u and v in [-1, 2].
/// NaN: NaN in a coordinate.
/// Error: 2 2^-p in each coordinate, the largest of which is 1 on the face.
GNOMON_KERNEL GNOMON_T(cube_vector) cube_direction(Real face, Real u, Real v)
{
    Real s = Real(2) * u - Real(1);
    Real t = Real(2) * v - Real(1);
    Real across = clamp_or_nan(s, Real(-1), Real(1));
    Real down = clamp_or_nan(t, Real(-1), Real(1));
    // The folded part is as far along the neighbour as the place is beyond the edge.
    Real ahead = (Real(1) - gnomon_abs(s - across)) - gnomon_abs(t - down);
    GNOMON_MASK along_z = Real(3.5) < face;
    GNOMON_MASK along_y = Real(1.5) < face && !along_z;
    GNOMON_MASK backward = face == Real(1) || face == Real(3) || face == Real(5);
    Real sign = gnomon_select(backward, Real(-1), Real(1));
    Real up = Real(-1) * down;
    GNOMON_T(cube_vector) r;
    r.x = gnomon_select(along_z, sign * across, gnomon_select(along_y, across, sign * ahead));
    r.y = gnomon_select(along_y, sign * ahead, up);
    r.z = gnomon_select(along_z, sign * ahead, gnomon_select(along_y, sign * down, Real(-1) * sign * across));
    return r;
}

GNOMON_NAMESPACE_END
#endif
