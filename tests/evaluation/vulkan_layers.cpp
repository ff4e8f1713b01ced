// Layered maps of the example vulkan_shadows, small, from either shading language: clusters, grids, texels and look-ups have the
// CPU's bits on a driver on the CPU, the whole keeps the tolerance of layer_comparison.hpp, and the validation layer has nothing
// to say.
#include "evaluation/vulkan/layer_comparison.hpp"
#include "renderer/device.hpp"
#include "renderer/scene/layered_stages.hpp"
#include "renderer/scene/moving_stages.hpp"

#include <stdexcept>
#include <string>
#include <vector>

using namespace gnomon;
using namespace gnomon::evaluation;

namespace {

const layer_sizes small{96, 54, 64, 4};
constexpr double aspect = 16. / 9;

layer_comparison check(const renderer::vulkan::device& gpu, const renderer::moving_stage& stage, bool hlsl)
{
    const bool on_cpu = gpu.physical().getProperties().deviceType == vk::PhysicalDeviceType::eCpu;
    layer_comparison both = compare_layers(gpu, (hlsl ? hlsl_shaders() : glsl_shaders()).layers, stage, small);
    for (const bit_difference& d :
         {both.clusters, both.grids, both.texels, both.plain, both.own, both.random, both.blended})
        CHECK(d.differing <= (on_cpu ? 0 : d.all));
    CHECK(both.receivers > 1000);
    CHECK(both.layers > 0);
    CHECK(both.of_whole.p99 <= double(layer_tolerance));
    CHECK(both.of_whole.errors.mean_abs <= 0.1 * double(layer_tolerance));
    return both;
}

} // namespace

TEST_CASE("the device's layers are those of the CPU: tentacles, some tiles in the plain map")
{
    const auto gpu = test::device_or_skip();
    if (!gpu) return;
    const renderer::moving_stage stage = renderer::tentacles(aspect, false);
    for (const bool hlsl : {false, true}) {
        CAPTURE(hlsl);
        const layer_comparison both = check(*gpu, stage, hlsl);
        CHECK(both.plain_tiles > 0);
        CHECK(both.layers > both.tiles - both.plain_tiles); // some tiles have several
        CHECK(both.plain.all > 0);
    }
    for (const std::string& complaint : gpu->complaints()) FAIL_CHECK(complaint);
}

TEST_CASE("the device's layers are those of the CPU: quads that cross")
{
    const auto gpu = test::device_or_skip();
    if (!gpu) return;
    check(*gpu, renderer::crossed_quads(aspect), false);
    for (const std::string& complaint : gpu->complaints()) FAIL_CHECK(complaint);
}

TEST_CASE("another scene is beyond the tolerance, and a map that is not of whole blocks is refused")
{
    const auto gpu = test::device_or_skip();
    if (!gpu) return;
    const auto both = compare_layers(*gpu, glsl_shaders().layers, renderer::crossed_quads(aspect), small);
    const auto other = compare_layers(*gpu, glsl_shaders().layers, renderer::toward_and_away(aspect), small);
    std::vector<std::size_t> pixels(both.host.pixels.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = i;
    CHECK(difference_of(both.device.visibility, other.host, pixels, layer_tolerance).p99 > double(layer_tolerance));
    const std::vector<stochastic_sample<float>> samples(48 * 48);
    CHECK_THROWS_AS(layer_device_map(*gpu, glsl_shaders().layers, {48, 48, 1, samples}), std::invalid_argument);
}
