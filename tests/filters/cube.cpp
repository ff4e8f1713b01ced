// Cube maps: faces and places by the tables of the graphics interfaces, and faces that unfold over edges.
#include "support/effort.hpp"
#include "support/hostile.hpp"
#include "support/rounding.hpp"

#include <gnomon/filters/cube.h>

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>

using namespace gnomon;
using namespace gnomon::test;

namespace {

/// The table of the OpenGL, Vulkan and Direct3D specifications: the axis of a face, of its u and of its v, as vectors.
struct face_axes {
    std::array<int, 3> ahead, across, down;
};
constexpr std::array<face_axes, 6> axes{{{{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
                                         {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
                                         {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},
                                         {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
                                         {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},
                                         {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}}}};

std::array<double, 3> by_table(std::size_t face, double s, double t, double ahead)
{
    std::array<double, 3> d{};
    for (std::size_t k = 0; k < 3; ++k)
        d[k] = ahead * axes[face].ahead[k] + s * axes[face].across[k] + t * axes[face].down[k];
    return d;
}

} // namespace

TEST_CASE_TEMPLATE("directions lead to the face and place of the specifications' table, and back", T, float, double)
{
    bit_source bits(1);
    for (std::int64_t i = 0; i < effort(50'000); ++i) {
        const std::size_t face = bits.below(6);
        const double s = bits.uniform(-0.9999, 0.9999), t = bits.uniform(-0.9999, 0.9999),
                     size = bits.uniform(0.01, 50);
        const auto d = by_table(face, s, t, 1);
        const cube_position<T> p = cube_position_from_direction(T(d[0] * size), T(d[1] * size), T(d[2] * size));
        REQUIRE(std::size_t(p.face) == face);
        REQUIRE(std::abs(double(p.u) - (s + 1) / 2) <= 4 * u<T>); // also the rounding of the direction
        REQUIRE(std::abs(double(p.v) - (t + 1) / 2) <= 4 * u<T>);
        REQUIRE(double(p.distance) == doctest::Approx(size));
        const cube_vector<T> back = cube_direction(p.face, p.u, p.v);
        for (const auto& [x, want] : {std::pair{back.x, d[0]}, {back.y, d[1]}, {back.z, d[2]}})
            REQUIRE(std::abs(double(x) - want) <= 10 * u<T>);
    }
}

TEST_CASE_TEMPLATE("places and directions have at most their stated errors", T, float, double)
{
    using exact = long double;
    bit_source bits(3);
    double place = 0, direction = 0;
    for (std::int64_t i = 0; i < effort(200'000); ++i) {
        const T x = T(bits.uniform(-1, 1)), y = T(bits.uniform(-1, 1)), z = T(bits.uniform(-1, 1));
        const cube_position<T> p = cube_position_from_direction(x, y, z);
        const face_axes& axis = axes[std::size_t(p.face)];
        const auto along = [&](const std::array<int, 3>& a) {
            return exact(a[0]) * exact(x) + exact(a[1]) * exact(y) + exact(a[2]) * exact(z);
        };
        REQUIRE(exact(p.distance) == along(axis.ahead));
        for (const auto& [got, a] : {std::pair{p.u, axis.across}, {p.v, axis.down}})
            place = std::max(place, std::abs(double(exact(got) - (along(a) / along(axis.ahead) + 1) / 2)) / u<T>);
        // Folded over one edge or over none.
        const T s = T(bits.uniform(-1, 2)), t = T(bits.uniform(0, 1));
        const cube_vector<T> d = cube_direction(p.face, s, t);
        const exact far_s = 2 * exact(s) - 1, near_s = std::min(std::max(far_s, exact(-1)), exact(1));
        const exact ahead = 1 - std::abs(far_s - near_s), down = 2 * exact(t) - 1;
        const std::array<T, 3> got{d.x, d.y, d.z};
        for (std::size_t k = 0; k < 3; ++k) {
            const exact want = ahead * axis.ahead[k] + near_s * axis.across[k] + down * axis.down[k];
            direction = std::max(direction, std::abs(double(exact(got[k]) - want)) / u<T>);
        }
    }
    for (const double error : {place, direction}) {
        CHECK(error <= 2);
        CHECK(error > 0.2);
    }
}

TEST_CASE("a face unfolds over each edge to the centres of the neighbour's texels, and back")
{
    for (const int size : {1, 2, 3, 7, 16, 100, 1023}) {
        const auto centre = [&](int i) { return (float(i) + 0.5f) / float(size); };
        for (int face = 0; face < 6; ++face) {
            std::set<int> neighbours;
            for (int side = 0; side < 4; ++side) {
                for (int step = 0; step < std::min(size, 20); ++step) {
                    for (int along = 0; along < size; along += 1 + size / 16) {
                        const int beyond = side < 2 ? -1 - step : size + step;
                        const int i = side % 2 == 0 ? beyond : along, j = side % 2 == 0 ? along : beyond;
                        const auto d = cube_direction(float(face), centre(i), centre(j));
                        const auto p = cube_position_from_direction(d.x, d.y, d.z);
                        REQUIRE(int(p.face) != face);
                        neighbours.insert(int(p.face));
                        const float x = p.u * float(size) - 0.5f, y = p.v * float(size) - 0.5f;
                        REQUIRE(std::abs(x - std::round(x)) <= 1e-3f);
                        REQUIRE(std::abs(y - std::round(y)) <= 1e-3f);
                        // The neighbour's texel is as far from the edge, at the same height along it.
                        const int to_edge = std::min({int(std::round(x)), int(std::round(y)),
                                                      size - 1 - int(std::round(x)), size - 1 - int(std::round(y))});
                        REQUIRE(to_edge <= step);
                        const std::array<float, 3> there{d.x, d.y, d.z};
                        const auto edge = by_table(
                            std::size_t(face), i == beyond ? (side < 2 ? -1.0 : 1.0) : 2.0 * double(centre(i)) - 1,
                            j == beyond ? (side < 2 ? -1.0 : 1.0) : 2.0 * double(centre(j)) - 1, 1);
                        double distance = 0;
                        for (std::size_t k = 0; k < 3; ++k) distance += std::abs(edge[k] - double(there[k]));
                        REQUIRE(distance == doctest::Approx(2 * (step + 0.5) / size));
                    }
                }
            }
            CHECK(neighbours.size() == 4);
            CHECK(neighbours.count(face ^ 1) == 0); // the opposite face is no neighbour
        }
    }
}

TEST_CASE_TEMPLATE("any bits give a face, a place on it, and no surprise for the zero vector", T, float, double)
{
    hostile_source<T> source(2);
    for (std::int64_t i = 0; i < effort(100'000); ++i) {
        const auto x = source.draw();
        const cube_position<T> p = cube_position_from_direction(x[0], x[1], x[2]);
        REQUIRE((p.face >= 0 && p.face <= 5 && p.face == std::floor(p.face)));
        REQUIRE((p.u >= 0 && p.u <= 1));
        REQUIRE((p.v >= 0 && p.v <= 1));
    }
    const cube_position<T> none = cube_position_from_direction(T(0), T(0), T(0));
    CHECK(none.face == 4);
    CHECK(none.u == T(0.5));
    CHECK(none.v == T(0.5));
    CHECK(none.distance == 0);
}
