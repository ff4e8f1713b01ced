// Methods of the registry: packs, kernels and single texels give the bits of a look-up; receivers know their plane.
#include "evaluation/core/method.hpp"
#include "renderer/scene/camera.hpp"
#include "support/hostile.hpp"

#include <gnomon/passes/blur.hpp>

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <memory>
#include <vector>

using namespace gnomon;
using namespace gnomon::evaluation;

namespace {

constexpr int resolution = 32;

// Two surfaces with a border that runs across texels.
depth_map some_depths()
{
    test::bit_source bits(1);
    depth_map result(resolution, resolution);
    for (std::size_t i = 0; i < result.pixels.size(); ++i)
        for (float& z : result.pixels[i]) z = float(bits.below(2) ? bits.uniform(-0.5, -0.4) : bits.uniform(0.3, 0.4));
    return result;
}

std::vector<map_receiver> some_receivers(std::size_t count)
{
    test::bit_source bits(2);
    std::vector<map_receiver> result(count);
    for (map_receiver& r : result)
        r = {float(bits.uniform(0, 1)), float(bits.uniform(0, 1)), float(bits.uniform(0, 6)),
             float(bits.uniform(-1, 1))};
    return result;
}

template <class Method> std::vector<const Method*> all_of()
{
    const std::vector<const Method*> result = registry_of<method>().all_of<Method>();
    REQUIRE(result.size() >= 16);
    return result;
}

} // namespace

TEST_CASE("packs and kernels have the bits of one look-up after the other")
{
    const depth_map depths = some_depths();
    const auto taps = gaussian_weights();
    const std::vector<map_receiver> where = some_receivers(1000);
    for (const shadow_method* m : all_of<shadow_method>()) {
        CAPTURE(m->id);
        const std::unique_ptr<shadow_map> map = m->build(depths, taps);
        CHECK(double(map->bytes()) >= m->format.bytes_per_texel * resolution * resolution);
        std::vector<float> expected(where.size());
        map->intensities(where, expected);
        int between = 0;
        for (const float x : expected) {
            REQUIRE((x >= 0 && x <= 1));
            between += x > 0.1f && x < 0.9f;
        }
        CHECK(between > 20); // of penumbrae
        for (const timed_look_up& way : map->timed(where))
            for (const timed_run* run : {&way.kernel, &way.look_up}) {
                CAPTURE(way.lanes);
                std::vector<float> found(where.size(), -1);
                run->run(found);
                REQUIRE(run->receivers > where.size() - std::size_t(way.lanes));
                REQUIRE(std::equal(found.begin(), found.begin() + std::ptrdiff_t(run->receivers), expected.begin()));
            }
    }
}

TEST_CASE("a texel of one depth shadows nothing in front and is stored without loss")
{
    for (const filterable_method* m : all_of<filterable_method>()) {
        CAPTURE(m->id);
        for (const float z : {-0.75f, 0.0f, 0.5f}) {
            const filterable_method::channels c = m->from_depth(z);
            CHECK(m->store(c) == c);
            CHECK(m->intensity(c, z - 0.25f) < 0.02f);
            CHECK(m->intensity(c, 1) > 0.8f);
        }
        CHECK_THROWS_AS(static_cast<void>(m->intensity(filterable_method::channels(33), 0)), std::invalid_argument);
    }
}

TEST_CASE("the gradient of depth is that of the receiver's plane")
{
    const std::vector<glm::vec3> world{{-1, -1, -1}, {1, 1, 1}};
    const std::array lights{renderer::orthographic_view(world, {0.3, -1, 0.2}),
                            renderer::perspective_view(world, {0.3, -1, 0.2}, 0.8)};
    test::bit_source bits(3);
    const auto random = [&] { return glm::dvec3(bits.uniform(-1, 1), bits.uniform(-1, 1), bits.uniform(-1, 1)); };
    for (const renderer::camera& light : lights)
        for (int i = 0; i < 100; ++i) {
            const glm::dvec3 p = random(), normal = glm::normalize(random());
            const glm::dvec2 found = depth_gradient(p, normal, light);
            if (!(glm::length(found) < 20)) continue; // nearly edge-on
            const glm::dvec3 across = 1e-5 * glm::normalize(glm::cross(normal, random()));
            const glm::dvec3 step = renderer::project(light, p + across) - renderer::project(light, p - across);
            CHECK(step.z == doctest::Approx(found.x * step.x + found.y * step.y).epsilon(1e-6).scale(1e-5));
        }
}
