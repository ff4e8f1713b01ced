// Blur and look-up across the faces of a cube: no seams along edges, nothing but means of texels, shapes checked.
#include "support/effort.hpp"
#include "support/hostile.hpp"

#include <gnomon/passes/cube.hpp>
#include <gnomon/storage/formats.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

using namespace gnomon;
using namespace gnomon::test;

namespace {

using format = moments4_float;

/// A cube of maps with its own memory.
struct cube_map {
    std::array<std::vector<format::texel>, 6> texels;
    std::size_t size;

    explicit cube_map(std::size_t n) : size(n)
    {
        for (auto& face : texels) face.assign(n * n, format::clear());
    }
    cube_view<format::texel> view()
    {
        const auto face = [&](std::size_t k) { return map_view<format::texel>(texels[k], size, size); };
        return {{face(0), face(1), face(2), face(3), face(4), face(5)}};
    }
};

/// The direction of a texel's centre.
std::array<float, 3> direction_of(std::size_t face, std::size_t i, std::size_t j, std::size_t size)
{
    const cube_vector<float> d =
        cube_direction(float(face), (float(i) + 0.5f) / float(size), (float(j) + 0.5f) / float(size));
    return {d.x, d.y, d.z};
}

template <class Depth> cube_map rendered(std::size_t size, Depth depth)
{
    cube_map cube(size);
    for (std::size_t face = 0; face < 6; ++face)
        for (std::size_t j = 0; j < size; ++j)
            for (std::size_t i = 0; i < size; ++i)
                cube.texels[face][j * size + i] =
                    format::encode(format::from_depth(depth(direction_of(face, i, j, size))));
    return cube;
}

cube_map blurred(cube_map& cube, std::span<const float> weights)
{
    cube_map scratch(cube.size), target(cube.size);
    blur_cube<format>(cube.view(), scratch.view(), target.view(), weights);
    return target;
}

/// The first moment in a direction.
float mean_at(cube_map& cube, float x, float y, float z) { return cube_bilinear<format>(cube.view(), x, y, z).c1; }

/// The largest jump of the look-up across the cube's edges, away from its corners.
float seam(cube_map& cube)
{
    float jump = 0;
    for (float along = -0.9f; along <= 0.9f; along += 0.01f)
        for (const float step : {-1.0f, 1.0f})
            for (const float other : {-1.0f, 1.0f})
                for (int axis = 0; axis < 3; ++axis) {
                    std::array<float, 3> a{}, b{};
                    const auto k = std::size_t(axis), l = std::size_t((axis + 1) % 3), m = std::size_t((axis + 2) % 3);
                    a[k] = b[k] = along, a[l] = step, b[l] = step * 0.999999f, a[m] = other * 0.999999f, b[m] = other;
                    jump = std::max(jump, std::abs(mean_at(cube, a[0], a[1], a[2]) - mean_at(cube, b[0], b[1], b[2])));
                }
    return jump;
}

} // namespace

TEST_CASE("a blurred cube has no seam, and its edges are not those of faces blurred alone")
{
    // A wall whose edge runs askew over several faces.
    const auto wall = [](std::array<float, 3> d) {
        return 0.3f * d[0] + 0.8f * d[1] - 0.45f * d[2] > 0.1f * std::hypot(d[0], d[1], d[2]) ? -0.4f : 0.8f;
    };
    cube_map cube = rendered(32, wall);
    const auto weights = gaussian_weights<9>();
    cube_map across = blurred(cube, weights);
    cube_map alone(32), scratch(32);
    for (std::size_t face = 0; face < 6; ++face)
        blur<format>(cube.view().faces[face], scratch.view().faces[face], alone.view().faces[face], weights);
    CHECK(seam(across) < 1e-4f);
    // Blurred by itself, a face repeats its own edge instead of the wall beyond.
    float difference = 0;
    for (std::size_t face = 0; face < 6; ++face)
        for (std::size_t k = 0; k < 32 * 32; ++k)
            difference = std::max(difference, std::abs(across.texels[face][k][0] - alone.texels[face][k][0]));
    CHECK(difference > 0.1f);
}

TEST_CASE("a caster beyond an edge shadows as on a flat map")
{
    // One dark column on face 4 beside its left edge; face 1 is its neighbour there.
    constexpr std::size_t size = 16;
    cube_map cube(size);
    const auto caster = format::encode(format::from_depth(-1.0f));
    for (std::size_t j = 0; j < size; ++j) cube.texels[4][j * size] = caster;
    const auto weights = gaussian_weights<5>();
    cube_map across = blurred(cube, weights);
    const format::texel flat_first = across.texels[4][8 * size + 1]; // a texel to the right of the column
    std::size_t found = 0;
    for (std::size_t k = 0; k < size * size; ++k) {
        const auto d = direction_of(1, k % size, k / size, size);
        if (std::abs(d[1]) < 0.5f && d[2] > 1 - 1.5f / float(size)) { // the texels of face 1 beside the edge
            ++found;
            CHECK(std::abs(across.texels[1][k][0] - flat_first[0]) < 1e-6f);
        }
    }
    CHECK(found == 8);
}

TEST_CASE("every result is a mean of texels, also at corners")
{
    bit_source bits(1);
    cube_map cube = rendered(8, [&](std::array<float, 3>) { return float(bits.uniform(-1, 1)); });
    const auto weights = gaussian_weights<7>();
    cube_map target = blurred(cube, weights);
    for (std::size_t face = 0; face < 6; ++face)
        for (std::size_t k = 0; k < 64; ++k) {
            REQUIRE(std::abs(target.texels[face][k][0]) <= 1);
            REQUIRE(target.texels[face][k][1] >= target.texels[face][k][0] * target.texels[face][k][0] - 1e-6f);
        }
    cube_map constant = rendered(8, [](std::array<float, 3>) { return 0.25f; });
    for (const auto& face : blurred(constant, weights).texels)
        for (const auto& t : face) REQUIRE(std::abs(t[0] - 0.25f) < 1e-6f);
    for (std::int64_t i = 0; i < effort(20'000); ++i)
        REQUIRE(mean_at(constant, float(bits.uniform(-1, 1)), float(bits.uniform(-1, 1)), float(bits.uniform(-1, 1))) ==
                0.25f);
    // Look-ups at the centres of texels return them.
    for (std::size_t face = 0; face < 6; ++face)
        for (std::size_t k = 0; k < 64; ++k) {
            const auto d = direction_of(face, k % 8, k / 8, 8);
            REQUIRE(std::abs(mean_at(cube, d[0], d[1], d[2]) - cube.texels[face][k][0]) < 1e-5f);
        }
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const float x : {nan, 0.0f, HUGE_VALF, -HUGE_VALF})
        for (const float y : {nan, 0.0f, 1.0f, HUGE_VALF})
            CHECK(mean_at(constant, x, y, 0) == (std::isnan(x) || std::isnan(y) ? 1 : 0.25f)); // the border is 1
}

TEST_CASE("shapes that do not fit are refused by name")
{
    cube_map cube(4), scratch(4), target(4), small(3);
    const auto weights = gaussian_weights<3>();
    const auto blur = [&](cube_map& a, cube_map& b, cube_map& c, std::span<const float> w) {
        blur_cube<format>(a.view(), b.view(), c.view(), w);
    };
    CHECK_NOTHROW(blur(cube, scratch, cube, weights));
#if defined(__cpp_exceptions)
    CHECK_THROWS_WITH(blur(cube, small, target, weights),
                      "gnomon: blur_cube: target.width is 3, but source.width is 4");
    CHECK_THROWS_AS(blur(cube, cube, target, weights), std::invalid_argument);
    CHECK_THROWS_WITH(blur(cube, scratch, target, gaussian_weights<9>()),
                      "gnomon: blur_cube: weights.size() / 2 is 4, but source.size() is 4");
    cube_view<format::texel> crooked = cube.view();
    crooked.faces[3].height = 3;
    CHECK_THROWS_WITH(blur_cube<format>(crooked, scratch.view(), target.view(), weights),
                      "gnomon: blur_cube: source.faces[3].height is 3, but faces[0].width is 4");
#endif
}
