// A scene, a camera and a light as shaders read them, and the picture that comes back.
#pragma once

#include "device.hpp"
#include "renderer/output/image.hpp"
#include "renderer/scene/camera.hpp"
#include "renderer/scene/scene.hpp"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace gnomon::renderer::vulkan {

// The bytes of a value, as push constants.
template <class T> push_constants bytes_of(const T& value) { return std::as_bytes(std::span(&value, 1)); }

// A buffer that holds these values.
template <class T>
buffer filled(const device& owner, std::span<const T> values,
              vk::BufferUsageFlags usage = vk::BufferUsageFlagBits::eStorageBuffer)
{
    buffer result(owner, values.size_bytes(), usage);
    std::ranges::copy(values, result.mapped<T>().begin());
    return result;
}

// Three vectors for each corner of each triangle: position, the triangle's normal, albedo.
std::vector<glm::vec3> corners_of(const scene& world);

// Two vectors for each corner of each translucent triangle: position, then texture coordinates and opacity to red light.
// Triangles come from the farthest to the nearest, by the distance of their centres from the camera.
std::vector<glm::vec3> layers_of(const scene& world, const camera& eye);

// The rows of the matrix from positions to Vulkan's clip space, in which y points down and depth goes from 0 to 1.
std::array<glm::vec4, 4> clip_rows(const camera& eye);

// The rows of the matrix from positions to texture coordinates and signed depth in the shadow map of a directional
// light.
std::array<glm::vec4, 3> shadow_rows(const camera& light);

// Level 0 of an image that can be copied from, whose texels are of type T.
template <class T = glm::vec4> renderer::image<T> read_back(const device& owner, const image& source)
{
    renderer::image<T> result(int(source.extent().width), int(source.extent().height));
    const buffer pixels(owner, result.pixels.size() * sizeof(T), vk::BufferUsageFlagBits::eTransferDst);
    owner.run([&](const vk::raii::CommandBuffer& commands) { copy(commands, source, pixels); });
    std::ranges::copy(pixels.mapped<T>(), result.pixels.begin());
    return result;
}

// The colours of a picture with an alpha channel.
picture without_alpha(const renderer::image<glm::vec4>& source);

} // namespace gnomon::renderer::vulkan
