// The example vulkan_shadows, small, from either shading language: its shadows are those of the CPU, within the
// tolerance that side_by_side.hpp derives, and the validation layer has nothing to say.
#include "evaluation/vulkan/side_by_side.hpp"
#include "renderer/device.hpp"
#include "renderer/scene/stage.hpp"

using namespace gnomon;
using namespace gnomon::evaluation;

namespace {

const settings small{.width = 320, .height = 180, .map_resolution = 256};

// The mean, and the share of receivers that are off without an edge to blame, may have a tenth of the tolerance.
void check(const difference_statistics& d, double tolerance)
{
    CHECK(d.p99 <= tolerance);
    CHECK(d.errors.mean_abs <= 0.1 * tolerance);
    CHECK(d.beyond_inside <= 0.1 * tolerance);
}

} // namespace

TEST_CASE("the device's shadows are those of the CPU")
{
    const auto gpu = test::device_or_skip();
    if (!gpu) return;
    const renderer::stage scenery = renderer::fence_stage(double(small.width) / small.height);
    for (const bool hlsl : {false, true}) {
        CAPTURE(hlsl);
        settings how = small;
        how.hlsl = hlsl;
        const device_comparison comparison(*gpu, scenery, how);
        REQUIRE(!device_methods().empty());
        for (const filterable_method* m : device_methods()) {
            CAPTURE(m->id);
            REQUIRE(comparison.possible(*m));
            check(comparison.render(*m).difference, double(comparison.tolerance()));
        }
    }
    for (const std::string& complaint : gpu->complaints()) FAIL_CHECK(complaint);
}

TEST_CASE("another method's shadows are beyond the tolerance")
{
    const auto gpu = test::device_or_skip();
    if (!gpu) return;
    const renderer::stage scenery = renderer::fence_stage(double(small.width) / small.height);
    const device_comparison comparison(*gpu, scenery, small);
    const auto method_of = [](const char* id) -> const filterable_method& {
        return dynamic_cast<const filterable_method&>(registry_of<method>().at(id));
    };
    const auto wrong = comparison.difference(comparison.render(method_of("msm4_unorm16")).device.visibility,
                                             comparison.render(method_of("msm4_float")).host, comparison.tolerance());
    CHECK(wrong.p99 > double(comparison.tolerance()));
    CHECK(wrong.errors.mean_abs > 0.1 * double(comparison.tolerance()));
}
