// A device with validation; where there is none, the test case ends with a word that ctest takes for a skip, or fails
// in continuous integration, which has a driver.
#pragma once

#include "renderer/vulkan/device.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <optional>
#include <string>

namespace test {

inline std::optional<gnomon::renderer::vulkan::device> device_or_skip()
{
    using namespace gnomon::renderer;
    try {
        return vulkan::device(vulkan::validation::on);
    } catch (const vulkan::unavailable& error) {
        const char* ci = std::getenv("CI");
        if (ci && std::string(ci) == "true") FAIL(error.what());
        MESSAGE("skipped: no Vulkan device: " << error.what());
        return {};
    }
}

} // namespace test
