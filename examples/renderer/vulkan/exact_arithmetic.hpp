// SPIR-V whose operations on floats keep the bits that the standard promises.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::renderer::vulkan {

// The module with every operation on floats decorated NoContraction: drivers fuse and reorder what is not.
std::vector<std::uint32_t> exact_arithmetic(std::span<const std::uint32_t> spirv);

} // namespace gnomon::renderer::vulkan
