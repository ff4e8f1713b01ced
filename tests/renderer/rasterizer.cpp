// Coverage is compared with the definition (every sample of a plane belongs to exactly one of its triangles), depth
// with an independent ray tracer, parallel runs with serial ones.
#include "renderer/raster/rasterizer.hpp"

#include "renderer/scene/stage.hpp"

#include <doctest/doctest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <rapidcheck.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

using namespace gnomon::renderer;

namespace {

mesh triangles(std::vector<glm::vec3> positions)
{
    mesh result{.name = "triangles", .positions = std::move(positions), .normals = {}, .triangles = {}};
    for (std::uint32_t i = 0; i + 2 < result.positions.size(); i += 3)
        result.triangles.push_back(i + glm::uvec3(0, 1, 2));
    return result;
}

// Cuts the square [-1.5, 1.5]^2 into cells with jittered corners, tilted along z, as separate triangles. Corners lie on
// a lattice that holds sample positions and pixel centres, so that edges and corners often pass through samples.
std::vector<glm::vec3> jittered_plane(unsigned seed, int pixels, float tilt)
{
    constexpr int cells = 8;
    std::mt19937 random(seed);
    const float lattice = 2.f / static_cast<float>(16 * pixels);
    std::uniform_int_distribution jitter(-pixels / 2, pixels / 2);
    std::vector<glm::vec3> corners;
    for (int y = 0; y <= cells; ++y)
        for (int x = 0; x <= cells; ++x) {
            glm::vec2 corner = 3.f * glm::vec2(x, y) / static_cast<float>(cells) - 1.5f;
            corner = lattice * (glm::round(corner / lattice) + glm::vec2(jitter(random), jitter(random)));
            corners.emplace_back(corner, tilt * corner.x);
        }
    std::vector<glm::vec3> result;
    for (int y = 0; y < cells; ++y)
        for (int x = 0; x < cells; ++x) {
            const auto at = [&](int i, int j) {
                return corners[static_cast<std::size_t>((y + j) * (cells + 1) + x + i)];
            };
            // Either diagonal, and either orientation: both sides of a triangle are drawn.
            if (random() % 2) result.insert(result.end(), {at(0, 0), at(1, 0), at(1, 1), at(0, 0), at(1, 1), at(0, 1)});
            else result.insert(result.end(), {at(0, 0), at(1, 0), at(0, 1), at(1, 1), at(1, 0), at(0, 1)});
        }
    return result;
}

// The number of triangles that cover each sample.
template <int Samples> std::vector<int> coverage(const std::vector<glm::vec3>& plane, const camera& eye, int pixels)
{
    std::vector<int> count(static_cast<std::size_t>(pixels * pixels * Samples));
    for (std::size_t i = 0; i < plane.size(); i += 3) {
        const scene one{"", {triangles({plane[i], plane[i + 1], plane[i + 2]})}};
        const auto depth = rasterize_depth<Samples>(one, eye, pixels, pixels);
        for (std::size_t k = 0; k < count.size(); ++k) count[k] += depth.pixels[k / Samples][k % Samples] < 1;
    }
    return count;
}

template <int Samples> bool covers_once(const std::vector<glm::vec3>& plane, const camera& eye, int pixels)
{
    return std::ranges::all_of(coverage<Samples>(plane, eye, pixels), [](int n) { return n == 1; });
}

camera looking_at_plane(projection kind)
{
    camera eye{.kind = kind, .position = {0, 0, 2}, .near_distance = 0.5, .far_distance = 4};
    if (eye.perspective()) eye.half_extent = {0.5, 0.5}; // the unit square at distance two
    return eye;
}

struct hit {
    double distance;
    bool certain; // neither near an edge nor near the near plane, where snapping to 1/256 pixel may decide otherwise
};

// Moeller and Trumbore; nothing where the ray passes clearly outside.
std::optional<hit> intersect(const view_ray& ray, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                             double near_distance)
{
    const glm::dvec3 p = glm::cross(ray.direction, c - a), q = glm::cross(ray.origin - a, b - a);
    const double determinant = glm::dot(p, b - a);
    const double u = glm::dot(p, ray.origin - a) / determinant, v = glm::dot(q, ray.direction) / determinant;
    const double t = glm::dot(q, c - a) / determinant, inside = std::min({u, v, 1 - u - v});
    // 1/256 pixel moves a weight by no more than this: triangles that see less than a fifth of a pixel are not drawn
    // below.
    constexpr double margin = 0.02;
    if (!(inside > -margin) || t < near_distance - margin) return {};
    return hit{t, inside > margin && t > near_distance + margin};
}

template <class Value> bool same_bits(const image<Value>& a, const image<Value>& b)
{
    return std::ranges::equal(a.pixels, b.pixels, [](const Value& p, const Value& q) {
        if constexpr (std::is_same_v<Value, surface>)
            return p.mesh == q.mesh && p.position == q.position && p.normal == q.normal &&
                   p.shading_normal == q.shading_normal && p.d_dx == q.d_dx && p.d_dy == q.d_dy;
        else return p == q;
    });
}

} // namespace

TEST_CASE("every sample of a triangulated plane is covered exactly once")
{
    constexpr int pixels = 48;
    const camera parallel = looking_at_plane(projection::orthographic),
                 central = looking_at_plane(projection::perspective);
    CHECK(rc::check("orthographic and perspective, one and four samples", [&](unsigned seed, bool tilted) {
        const auto plane = jittered_plane(seed, pixels, tilted ? 0.25f : 0.f);
        RC_ASSERT(covers_once<1>(plane, parallel, pixels));
        RC_ASSERT(covers_once<4>(plane, parallel, pixels));
        RC_ASSERT(covers_once<4>(plane, central, pixels));
    }));
}

TEST_CASE("cut by the near plane, the far plane and the guard band, a plane is still covered exactly once")
{
    constexpr int pixels = 48;
    const camera eye = looking_at_plane(projection::perspective);
    CHECK(rc::check("where a ray meets the plane between near and far", [&](unsigned seed) {
        const float tilt = *rc::gen::element(0.f, 0.25f, 3.f, 40.f);
        auto plane = jittered_plane(seed, pixels, tilt);
        for (glm::vec3& corner : plane) corner *= 1000.f;
        const std::vector<int> count = coverage<1>(plane, eye, pixels);
        for (int i = 0; i < pixels * pixels; ++i) {
            const view_ray ray = ray_through(eye, (glm::dvec2(i % pixels, i / pixels) + 0.5) / double(pixels));
            const double t =
                eye.position.z / (1 + double(tilt) * ray.direction.x); // z = tilt x, where x and z are affine in t
            const int n = count[static_cast<std::size_t>(i)];
            // Snapping moves the cut by 1/256 pixel, 8e-5 in x, which changes t by t^2 tilt / 2 times as much: 0.03 at
            // t = 4.
            if (t > 0.52 && t < 3.9) RC_ASSERT(n == 1);
            else if (t < 0.48 || t > 4.1) RC_ASSERT(n == 0);
            else RC_ASSERT(n <= 1);
        }
    }));
}

TEST_CASE("a pixel centre on the edge of a quad belongs to the left or upper edge")
{
    // The quad's outline runs through pixel centres: 2.5 to 5.5 of 8 pixels.
    const auto at = [](float pixel) { return pixel / 4 - 1; };
    const float low = at(2.5f), high = at(5.5f);
    mesh quad{.name = "quad", .positions = {}, .normals = {}, .triangles = {}};
    add_quad(quad, {low, -high, 0}, {high - low, 0, 0}, {0, high - low, 0});
    const auto depth = rasterize_depth<1>({"", {quad}}, looking_at_plane(projection::orthographic), 8, 8);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) CHECK((depth(x, y)[0] < 1) == (x >= 2 && x < 5 && y >= 2 && y < 5));
}

TEST_CASE("depth is that of the nearest ray-plane intersection")
{
    constexpr int width = 60, height = 44;
    std::mt19937 random(7);
    std::uniform_real_distribution<float> place(-1, 1);
    for (const projection kind : {projection::orthographic, projection::perspective}) {
        // Near plane at z = 1.2, far plane behind everything: some triangles are clipped.
        camera eye{.kind = kind, .position = {0, 0, 2}, .near_distance = 0.8, .far_distance = 8};
        eye.half_extent = {0.8, 0.6};
        std::vector<glm::vec3> corners;
        for (int i = 0; i < 3 * 16; ++i)
            corners.emplace_back(2 * place(random), 2 * place(random), 3 * place(random) - 1);
        const auto depth = rasterize_depth<4>({"", {triangles(corners)}}, eye, width, height);
        int compared = 0, covered = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (std::size_t s = 0; s < 4; ++s) {
                    const glm::dvec2 pixel = glm::dvec2(x, y) + 0.5 + glm::dvec2(sample_offsets<4>[s]) / 16.0;
                    const view_ray ray = ray_through(eye, pixel / glm::dvec2(width, height));
                    double nearest = eye.far_distance;
                    bool certain = true;
                    for (std::size_t i = 0; i < corners.size(); i += 3)
                        if (const auto h =
                                intersect(ray, corners[i], corners[i + 1], corners[i + 2], eye.near_distance))
                            nearest = std::min(nearest, h->distance), certain = certain && h->certain;
                    if (!certain) continue;
                    ++compared, covered += nearest < eye.far_distance;
                    // One rounding to float of a number in [-1, 1], and the two reckonings in double.
                    CHECK(std::abs(double(depth(x, y)[s]) - linear_depth(eye, nearest)) <= 0x1p-24 + 1e-10);
                }
        CHECK(compared > width * height);
        CHECK(covered > compared / 4);
    }
}

TEST_CASE("a surface lies on the ray of its pixel, and its derivatives lead to its neighbours")
{
    constexpr int size = 64;
    for (const projection kind : {projection::orthographic, projection::perspective}) {
        const camera eye = looking_at_plane(kind);
        const scene plane{"", {triangles(jittered_plane(3, size, 0.25f))}};
        const auto seen = rasterize_surfaces(plane, eye, size, size);
        const glm::vec3 normal = glm::normalize(glm::vec3(-0.25f, 0, 1));
        for (int y = 0; y < size - 1; ++y)
            for (int x = 0; x < size - 1; ++x) {
                const surface& s = seen(x, y);
                REQUIRE(s.valid());
                const glm::dvec3 p = project(eye, s.position);
                // Positions are floats of size one, a pixel of 64 is 2^-6: 2^-24 / 2^-6 is below 1e-5 pixel.
                CHECK(std::abs(p.x * size - (x + 0.5)) < 1e-5);
                CHECK(std::abs(p.y * size - (y + 0.5)) < 1e-5);
                CHECK(std::abs(s.position.z - 0.25f * s.position.x) < 1e-6);
                CHECK(glm::distance(s.normal, normal) < 1e-5);
                // In perspective the step is affine up to second order: (pixel angle)^2 = 2^-12, times the plane's
                // tilt.
                const float second_order = eye.perspective() ? 0x1p-12f : 1e-6f;
                CHECK(glm::distance(s.position + s.d_dx, seen(x + 1, y).position) < second_order);
                CHECK(glm::distance(s.position + s.d_dy, seen(x, y + 1).position) < second_order);
            }
    }
}

TEST_CASE("front and back faces differ by orientation, shading normals are interpolated")
{
    mesh facing = triangles({{-2, -2, 0}, {2, -2, 0}, {0, 2, 0}});
    facing.normals = {{-1, 0, 1}, {1, 0, 1}, {0, 0, 1}};
    const scene world{"", {facing}};
    const camera eye = looking_at_plane(projection::orthographic);
    CHECK(rasterize_surfaces(world, eye, 8, 8, faces::front)(4, 4).valid());
    CHECK_FALSE(rasterize_surfaces(world, eye, 8, 8, faces::back)(4, 4).valid());
    const surface left = rasterize_surfaces(world, eye, 8, 8)(0, 4), right = rasterize_surfaces(world, eye, 8, 8)(7, 4);
    CHECK(left.shading_normal.x < -0.1f);
    CHECK(right.shading_normal.x > 0.1f);
    CHECK(left.shading_normal.x == doctest::Approx(double(-right.shading_normal.x)).epsilon(1e-6));
}

TEST_CASE("hostile triangles leave depths in [-1, 1]")
{
    std::vector<float> values{0, 1, -1, 1e-30f, 1e30f, -1e30f, 3e38f, -3e38f, 1e-45f, NAN, INFINITY, 2.0000002f};
    CHECK(rc::check("any corners", [&] {
        std::vector<glm::vec3> corners;
        for (int i = 0; i < 9; ++i)
            corners.emplace_back(*rc::gen::elementOf(values), *rc::gen::elementOf(values), *rc::gen::elementOf(values));
        for (const projection kind : {projection::orthographic, projection::perspective}) {
            const camera eye = looking_at_plane(kind);
            const scene world{"", {triangles(corners)}};
            const auto depth = rasterize_depth<1>(world, eye, 16, 16);
            RC_ASSERT(std::ranges::all_of(depth.pixels, [](const auto& d) { return d[0] >= -1 && d[0] <= 1; }));
            rasterize_surfaces(world, eye, 16, 16);
        }
    }));
}

TEST_CASE("results do not depend on the number of threads")
{
    const stage fence = fence_stage(1.5);
    const auto render = [&](int threads) {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                          static_cast<std::size_t>(threads));
        tbb::task_arena arena(threads);
        return arena.execute([&] {
            return std::pair(rasterize_depth<4>(fence.world, fence.light, 256, 256),
                             rasterize_surfaces(fence.world, fence.eye, 150, 100));
        });
    };
    const auto serial = render(1);
    for (const int threads : {2, 7}) {
        const auto parallel = render(threads);
        CHECK(same_bits(serial.first, parallel.first));
        CHECK(same_bits(serial.second, parallel.second));
    }
}

TEST_CASE("impossible sizes are refused")
{
    const camera eye = looking_at_plane(projection::orthographic);
    CHECK_THROWS_WITH(rasterize_depth<1>({}, eye, 0, 4), "rasterizer: 0x4 pixels, 1 to 16384 per side are possible");
    CHECK_THROWS(rasterize_surfaces({}, eye, 4, 1 << 20));
}
