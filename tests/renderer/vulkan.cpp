// The renderer's Vulkan: compute passes with their constants, complaints of the validation layer, mip levels, matrices
// of shaders, and a clear error without a driver.
#include "device.hpp"
#include "probe.h"
#include "renderer/vulkan/exact_arithmetic.hpp"
#include "renderer/vulkan/scene.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <span>
#include <string>

using namespace gnomon::renderer;

TEST_CASE("a compute pass reads buffers, push constants and specialization constants")
{
    const auto gpu = test::device_or_skip();
    if (!gpu) return;
    constexpr std::uint32_t groups = 5, count = 64 * groups;
    const vulkan::buffer input(*gpu, count * sizeof(float)), output(*gpu, count * sizeof(float));
    const std::span<float> values = input.mapped<float>(), results = output.mapped<float>();
    REQUIRE(values.size() == count);
    std::iota(values.begin(), values.end(), 1.f);
    const std::array factor{3.f};
    const vulkan::shader code{probe, {std::bit_cast<std::uint32_t>(0.5f)}};
    const vulkan::compute_pass pass(*gpu, code, {input, output}, sizeof(factor));
    const vulkan::timeline times(*gpu, 3);
    gpu->run([&](const vk::raii::CommandBuffer& commands) {
        times.reset(commands);
        times.mark(commands, 0);
        pass.record(commands, {groups, 1, 1}, std::as_bytes(std::span(factor)));
        times.mark(commands, 1);
        times.mark(commands, 2);
    });
    for (std::size_t i = 0; i < count; ++i) CHECK(results[i] == 3 * values[i] + 0.5f); // small whole numbers: exact

    // A decoration of three words for the product and for the sum.
    const std::vector<std::uint32_t> exact = vulkan::exact_arithmetic(probe);
    CHECK(exact.size() == std::size(probe) + 6);
    const vulkan::compute_pass same(*gpu, {exact, code.constants}, {input, output}, sizeof(factor));
    std::ranges::fill(results, 0.f);
    gpu->run([&](const vk::raii::CommandBuffer& commands) {
        same.record(commands, {groups, 1, 1}, std::as_bytes(std::span(factor)));
    });
    for (std::size_t i = 0; i < count; ++i) CHECK(results[i] == 3 * values[i] + 0.5f);
    // The header has five words; the first instruction, a capability, is cut after its first word.
    CHECK_THROWS_AS(vulkan::exact_arithmetic(std::span(probe).first(6)), std::invalid_argument);

    const std::vector<double> milliseconds = times.milliseconds();
    REQUIRE(milliseconds.size() == 2);
    CHECK(milliseconds[0] > 0);
    CHECK(milliseconds[1] >= 0);
    CHECK(gpu->complaints().empty());
}

TEST_CASE("complaints of the validation layer are kept")
{
    const auto gpu = test::device_or_skip();
    if (!gpu) return;
    const vk::raii::Buffer of_no_use(gpu->handle(), {{}, 64, {}});
    REQUIRE(gpu->complaints().size() == 1);
    CHECK(gpu->complaints().front().find("VUID-VkBufferCreateInfo-usage") != std::string::npos);
}

TEST_CASE("mip levels are means, and a copy has the rows of level 0")
{
    const auto gpu = test::device_or_skip();
    if (!gpu) return;
    using usage = vk::ImageUsageFlagBits;
    const vulkan::image whole(*gpu, vk::Format::eR32Sfloat, {8, 4},
                              usage::eSampled | usage::eTransferSrc | usage::eTransferDst, 4);
    const vulkan::buffer top(*gpu, 32 * sizeof(float), vk::BufferUsageFlagBits::eTransferSrc);
    const vulkan::buffer again(*gpu, 32 * sizeof(float), vk::BufferUsageFlagBits::eTransferDst);
    const vulkan::buffer last(*gpu, sizeof(float), vk::BufferUsageFlagBits::eTransferDst);
    const std::span<float> values = top.mapped<float>();
    std::iota(values.begin(), values.end(), 0.f);
    gpu->run([&](const vk::raii::CommandBuffer& commands) {
        const auto part = [](std::uint32_t level, std::uint32_t width, std::uint32_t height) {
            return vk::BufferImageCopy(0, 0, 0, {vk::ImageAspectFlagBits::eColor, level, 0, 1}, {}, {width, height, 1});
        };
        commands.copyBufferToImage(top.handle(), whole.handle(), vk::ImageLayout::eGeneral, part(0, 8, 4));
        vulkan::barrier(commands);
        vulkan::build_mips(commands, whole);
        vulkan::copy(commands, whole, again);
        commands.copyImageToBuffer(whole.handle(), vk::ImageLayout::eGeneral, last.handle(), part(3, 1, 1));
    });
    CHECK(std::ranges::equal(again.mapped<float>(), values));
    CHECK(last.mapped<float>().front() == 15.5f); // whole numbers and halves: exact
    CHECK(gpu->complaints().empty());
}

TEST_CASE("without a driver the device is unavailable")
{
    for (const char* variable : {"VK_ICD_FILENAMES", "VK_DRIVER_FILES"}) {
        const char* earlier = std::getenv(variable);
        const std::string kept = earlier ? earlier : "";
        setenv(variable, "/nowhere.json", 1);
        CHECK_THROWS_AS(vulkan::device(), vulkan::unavailable);
        if (earlier) setenv(variable, kept.c_str(), 1);
        else unsetenv(variable);
    }
}

TEST_CASE("the matrices of shaders project as cameras do")
{
    const std::vector<glm::vec3> points{{-1, -2, 0.5f}, {2, 1, -3}, {0, 0.25f, 0}, {1.5f, -1, 2}};
    const glm::dvec3 direction(0.4, -1, 0.3);
    const camera sun = orthographic_view(points, direction), spot = perspective_view(points, direction, 0.9, 1.5);
    const auto times = [](const auto& rows, const glm::vec3& p) {
        std::array<double, std::tuple_size_v<std::remove_cvref_t<decltype(rows)>>> result;
        for (std::size_t i = 0; i < rows.size(); ++i) result[i] = double(glm::dot(rows[i], glm::vec4(p, 1)));
        return result;
    };
    for (const camera& eye : {sun, spot})
        for (const glm::vec3& p : points) {
            const glm::dvec3 expected = project(eye, p);
            const auto [x, y, z, w] = times(vulkan::clip_rows(eye), p);
            CHECK(std::abs(0.5 * x / w + 0.5 - expected.x) < 1e-6);
            CHECK(std::abs(0.5 * y / w + 0.5 - expected.y) < 1e-6);
            const double near = eye.near_distance, far = eye.far_distance, d = view_distance(eye, p);
            const double depth = eye.perspective() ? far * (d - near) / (d * (far - near)) : (d - near) / (far - near);
            CHECK(std::abs(z / w - depth) < 1e-5);
            if (eye.perspective()) continue;
            const auto [u, v, signed_depth] = times(vulkan::shadow_rows(eye), p);
            CHECK(std::abs(u - expected.x) < 1e-6);
            CHECK(std::abs(v - expected.y) < 1e-6);
            CHECK(std::abs(signed_depth - expected.z) < 1e-6);
        }
}
