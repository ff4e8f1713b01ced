// Scenes of boxes that move at random, above a ground, and a light.
#pragma once

#include "renderer/scene/moving_scene.hpp"
#include "support/hostile.hpp"

#include <glm/trigonometric.hpp>

#include <cstdint>

namespace gnomon::test {

/// Boxes that move, and that turn if wanted, above a ground.
inline renderer::moving_scene moving_boxes(std::uint64_t seed, int boxes, bool turn = true)
{
    using namespace renderer;
    bit_source bits(seed);
    const auto real = [&](double low, double high) { return static_cast<float>(bits.uniform(low, high)); };
    const auto point = [&](double reach) {
        return glm::vec3(real(-reach, reach), real(0, reach), real(-reach, reach));
    };
    moving_scene world{{"boxes", {}}, {}};
    mesh open{}, close{};
    for (int i = 0; i < boxes; ++i) {
        const glm::vec3 size(real(0.1, 1)), at = point(2);
        const float angle = real(-1, 1);
        add_box(open, upright(at, size, angle));
        add_box(close, upright(at + 0.5f * point(2), size, turn ? real(-1, 1) : angle));
    }
    world.open.meshes = {open, ground({0, 0, 0}, 8, 8, glm::vec3(0.5f))};
    world.closing = {close.positions, world.open.meshes[1].positions};
    return world;
}

/// A light that sees the whole scene.
inline renderer::moving_camera light_of(const renderer::moving_scene& world, bool perspective)
{
    using namespace renderer;
    const auto corners = bounds_of(world).corners();
    if (perspective) return {perspective_view_from({3, 7, 2}, {0, 0, 0}, corners, glm::radians(60.0), 1), {0, 0, 0}};
    return {orthographic_view(corners, {0.4, -1, 0.3})};
}

} // namespace gnomon::test
