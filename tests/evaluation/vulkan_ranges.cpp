// Maps of ranges of the example vulkan_shadows, small, from either shading language: lists, resolved lists and look-ups have
// the CPU's bits on a driver on the CPU, the whole keeps the tolerance that range_comparison.hpp derives, and the validation
// layer has nothing to say.
#include "evaluation/vulkan/range_comparison.hpp"
#include "renderer/device.hpp"
#include "renderer/scene/moving_stages.hpp"

#include <string>

using namespace gnomon;
using namespace gnomon::evaluation;

namespace {

const motion_sizes small{160, 90, 128, 1};
constexpr double aspect = 16. / 9;

void check(const bit_difference& d, bool same)
{
    CHECK(d.all > 0);
    CHECK(double(d.differing) <= (same ? 0 : double(d.all)));
}

void check(const renderer::vulkan::device& gpu, const renderer::moving_stage& stage)
{
    const bool on_cpu = gpu.physical().getProperties().deviceType == vk::PhysicalDeviceType::eCpu;
    for (const bool hlsl : {false, true}) {
        CAPTURE(hlsl);
        const auto both = compare_ranges(gpu, (hlsl ? hlsl_shaders() : glsl_shaders()).ranges, stage, small);
        check(both.lists, on_cpu);
        check(both.resolved, on_cpu);
        check(both.static_look_ups, on_cpu);
        check(both.moving_look_ups, on_cpu);
        CHECK(both.of_whole.p99 <= double(range_tolerance));
        CHECK(both.of_whole.errors.mean_abs <= 0.1 * double(range_tolerance));
    }
}

} // namespace

TEST_CASE("the device's ranges are those of the CPU: edges that are linear in time, and many triangles")
{
    const auto gpu = test::device_or_skip();
    if (!gpu) return;
    check(*gpu, renderer::random_cubes(aspect, 40, 0.5f));
    for (const std::string& complaint : gpu->complaints()) FAIL_CHECK(complaint);
}

TEST_CASE("the device's ranges are those of the CPU: blades that turn")
{
    const auto gpu = test::device_or_skip();
    if (!gpu) return;
    check(*gpu, renderer::fan(aspect));
    for (const std::string& complaint : gpu->complaints()) FAIL_CHECK(complaint);
}

TEST_CASE("another motion is beyond the tolerance")
{
    const auto gpu = test::device_or_skip();
    if (!gpu) return;
    const auto both = compare_ranges(*gpu, glsl_shaders().ranges, renderer::random_cubes(aspect, 40, 0.5f), small);
    const auto other = compare_ranges(*gpu, glsl_shaders().ranges, renderer::random_cubes(aspect, 40, 0.4f), small);
    std::vector<std::size_t> pixels(both.host.pixels.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = i;
    CHECK(difference_of(both.device.visibility, other.host, pixels, range_tolerance).p99 > double(range_tolerance));
}

TEST_CASE("a map that is not of whole tiles is refused")
{
    const auto gpu = test::device_or_skip();
    if (!gpu) return;
    const renderer::moving_stage stage = renderer::fan(aspect);
    CHECK_THROWS_AS(range_device_map(*gpu, glsl_shaders().ranges, stage.world, stage.light, 100, depth_tolerance),
                    std::invalid_argument);
}
