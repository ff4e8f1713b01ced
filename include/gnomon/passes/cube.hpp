// Blur and look-up across the faces of a cube map in its storage format (filters/cube.h). A face unfolds over its edges:
// taps beyond an edge are texels of the neighbour, so that shadows have no seams along edges. Around the eight corners,
// where three faces meet and no unfolding exists, taps go to the edge between the two neighbours, which repeats texels there.
// Every result is a mean of texels, so bounds stay as honest as on a flat map.
//
// Both passes of a blur go along the texture coordinates of the texel's own face. A texel sees the same distance to all
// sides in texels, not in angles: texels in the middle of a face span about twice the angle of those at its edges along
// each axis.
#ifndef GNOMON_PASSES_CUBE_HPP
#define GNOMON_PASSES_CUBE_HPP

#include "../filters/cube.h"
#include "blur.hpp"
#include "look_up.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

GNOMON_NAMESPACE_BEGIN

/// Six faces of size x size texels each, in the order of filters/cube.h.
template <class T> struct cube_view {
    std::array<map_view<T>, 6> faces;

    constexpr std::size_t size() const { return faces[0].width; }
    constexpr operator cube_view<const T>() const
    {
        return {{faces[0], faces[1], faces[2], faces[3], faces[4], faces[5]}};
    }
};

namespace detail {

/// Check that all faces are squares of the same extent, each in its own span.
template <class T> void expect_cube(std::string_view pass, std::string_view name, const cube_view<T>& cube)
{
    for (std::size_t face = 0; face < 6; ++face) {
        const std::string n = std::string(name).append(".faces[").append(std::to_string(face)).append("]");
        expect_map(pass, n, cube.faces[face]);
        GNOMON_EXPECTS(cube.faces[face].width == cube.size(),
                       mismatch(pass, n + ".width", cube.faces[face].width, "faces[0].width", cube.size()));
        GNOMON_EXPECTS(cube.faces[face].height == cube.size(),
                       mismatch(pass, n + ".height", cube.faces[face].height, "faces[0].width", cube.size()));
    }
}

/// Position index + 0.5 of `size` as a texture coordinate.
inline float texel_centre(std::ptrdiff_t index, std::size_t size) { return (float(index) + 0.5f) / float(size); }

/// The texel at a texture coordinate.
inline std::size_t texel_at(float coordinate, std::size_t size)
{
    return (std::min)(std::size_t(coordinate * float(size)), size - 1);
}

/// The texel in column i and row j of a face; beyond an edge, that of the face folded over the edge.
template <class T>
const T& cube_texel(const cube_view<const T>& cube, std::size_t face, std::ptrdiff_t i, std::ptrdiff_t j)
{
    const std::size_t size = cube.size();
    const auto n = std::ptrdiff_t(size);
    if (i >= 0 && i < n && j >= 0 && j < n) return cube.faces[face](std::size_t(i), std::size_t(j));
    const cube_vector d = cube_direction(float(face), texel_centre(i, size), texel_centre(j, size));
    const cube_position p = cube_position_from_direction(d.x, d.y, d.z);
    return cube.faces[std::size_t(p.face)](texel_at(p.u, size), texel_at(p.v, size));
}

/// Blur a face along its columns' index (along_u) or its rows', with the decoded texels under the taps in a ring.
template <texel_format Format>
void blur_cube_face(const cube_view<const format_texel<Format>>& source, map_view<format_texel<Format>> target,
                    std::size_t face, std::span<const float> weights, bool along_u)
{
    std::array<channel_array<Format>, maximum_blur_taps> ring{};
    const auto n = std::ptrdiff_t(source.size());
    const auto taps = std::ptrdiff_t(weights.size());
    const std::ptrdiff_t radius = taps / 2;
    for (std::ptrdiff_t line = 0; line < n; ++line) {
        const auto load = [&](std::ptrdiff_t p) {
            const auto& t = along_u ? cube_texel(source, face, p, line) : cube_texel(source, face, line, p);
            ring[std::size_t((p + radius) % taps)] = load_channels<Format>(t);
        };
        for (std::ptrdiff_t p = -radius; p < radius; ++p) load(p);
        for (std::ptrdiff_t i = 0; i < n; ++i) {
            load(i + radius);
            channel_array<Format> sum{};
            for (std::ptrdiff_t tap = 0; tap < taps; ++tap) {
                const float weight = weights[std::size_t(tap)];
                if (!((std::abs)(weight) > 0)) continue; // 0 times NaN is NaN
                const channel_array<Format>& c = ring[std::size_t((i + tap) % taps)];
                for (std::size_t k = 0; k < c.size(); ++k) sum[k] += weight * c[k];
            }
            const auto x = std::size_t(along_u ? i : line), y = std::size_t(along_u ? line : i);
            target(x, y) = store_channels<Format>(sum);
        }
    }
}

template <texel_format Format>
void expect_blur_cube(const cube_view<const format_texel<Format>>& source,
                      const cube_view<format_texel<Format>>& target, std::span<const float> weights)
{
    constexpr std::string_view pass = "blur_cube";
    expect_cube(pass, "source", source);
    expect_cube(pass, "target", target);
    for (std::size_t face = 0; face < 6; ++face) {
        expect_same_extent(pass, source.faces[face], target.faces[face]);
        for (std::size_t other = 0; other < 6; ++other) expect_apart(pass, source.faces[other], target.faces[face]);
    }
    expect_weights(pass, weights);
    GNOMON_EXPECTS(weights.size() / 2 < source.size(),
                   mismatch(pass, "weights.size() / 2", weights.size() / 2, "source.size()", source.size()));
}

} // namespace detail

/// Blur all faces along both axes: source to scratch, scratch to target. Target may be source. Weights: an odd number of
/// them, whose half is less than the size of a face, of any sign, with a sum within 0.01 of 1.
template <texel_format Format>
void blur_cube(const cube_view<const format_texel<Format>>& source, const cube_view<format_texel<Format>>& scratch,
               const cube_view<format_texel<Format>>& target, std::span<const float> weights)
{
    const cube_view<const format_texel<Format>> half_blurred = scratch;
    detail::expect_blur_cube<Format>(source, scratch, weights);
    detail::expect_blur_cube<Format>(half_blurred, target, weights);
    for (std::size_t face = 0; face < 6; ++face)
        detail::blur_cube_face<Format>(source, scratch.faces[face], face, weights, true);
    for (std::size_t face = 0; face < 6; ++face)
        detail::blur_cube_face<Format>(half_blurred, target.faces[face], face, weights, false);
}

/// Filtered channels in direction (x, y, z) from the light, of any length, by bilinear interpolation across edges.
/// Domain: a cube with texels, and any direction.
/// NaN: the border, lit.
template <texel_format Format>
format_channels<Format> cube_bilinear(const cube_view<const format_texel<Format>>& cube, float x, float y, float z)
{
    if ((std::isunordered)(x, y) || (std::isnan)(z)) return stored_border<Format>();
    const cube_position p = cube_position_from_direction(x, y, z);
    const auto face = std::size_t(p.face);
    const float u = p.u * float(cube.size()) - 0.5f, v = p.v * float(cube.size()) - 0.5f;
    const float left = std::floor(u), top = std::floor(v);
    const int next_u = u > left ? 1 : 0, next_v = v > top ? 1 : 0; // a texel without weight is not read
    const auto at = [&](int i, int j) {
        return load_channels<Format>(detail::cube_texel(cube, face, std::ptrdiff_t(left) + i, std::ptrdiff_t(top) + j));
    };
    return gnomon_bit_cast<format_channels<Format>>(
        detail::mix(detail::mix(at(0, 0), at(next_u, 0), u - left),
                    detail::mix(at(0, next_v), at(next_u, next_v), u - left), v - top));
}

GNOMON_NAMESPACE_END
#endif
