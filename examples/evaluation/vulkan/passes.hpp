// Passes of a device and their times.
#pragma once

#include "renderer/vulkan/device.hpp"

#include <functional>
#include <string>
#include <vector>

namespace gnomon::evaluation {

struct named_pass {
    std::string name;
    std::function<void(const vk::raii::CommandBuffer&)> record;
};

struct device_pass {
    std::string name;
    double milliseconds;
};

// Runs all passes in turn, several times over, and keeps the least time of each. The first run does not count: drivers
// compile in it.
std::vector<device_pass> timed(const renderer::vulkan::device& gpu, const std::vector<named_pass>& passes);

} // namespace gnomon::evaluation
