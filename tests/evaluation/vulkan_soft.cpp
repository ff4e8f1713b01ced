// Translucent and soft shadows of the example vulkan_shadows, small: the blend keeps the tolerance of
// blend_comparison.hpp, the summed-area table is that of the CPU bit by bit, its look-ups are those of the CPU, and the
// validation layer has nothing to say.
#include "evaluation/soft/soft_stage.hpp"
#include "evaluation/vulkan/blend_comparison.hpp"
#include "evaluation/vulkan/soft_comparison.hpp"
#include "renderer/device.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

using namespace gnomon;
using namespace gnomon::evaluation;

namespace {

const settings small{.width = 320, .height = 180, .map_resolution = 256};
const double aspect = double(small.width) / small.height;

// As in vulkan_shadows.cpp.
void check(const difference_statistics& d, double tolerance)
{
    CHECK(d.p99 <= tolerance);
    CHECK(d.errors.mean_abs <= 0.1 * tolerance);
    CHECK(d.beyond_inside <= 0.1 * tolerance);
}

} // namespace

TEST_CASE("translucent surfaces blend as on the CPU")
{
    const auto gpu = test::device_or_skip();
    if (!gpu) return;
    const renderer::stage scenery = smoke_stage(aspect);
    const std::vector<translucent_fragment> fragments = fragments_of(scenery, small.map_resolution);
    const std::vector<float> taps{0.25f, 0.5f, 0.25f};
    int blended = 0;
    for (const shading_language language : {shading_language::glsl, shading_language::hlsl}) {
        const blending_renderer drawn(*gpu, scenery, {320, 180}, small.map_resolution, taps, language);
        for (const blend_images way : {blend_images::one, blend_images::two}) {
            if (!drawn.supports(way)) continue;
            ++blended;
            const blended_frame frame = drawn.render(way);
            const blend_difference d = compare_blend(*gpu, frame, fragments);
            CHECK(d.layers > 20);
            CHECK(d.texels > 1000);
            CHECK(d.change > 30 * d.mean_allowed);
            CHECK(d.mean <= 0.1 * d.mean_allowed);
            CHECK(d.beyond_inside == 0);
            CHECK(d.beyond <= 0.03);

            // In the wrong order, or if one layer is missing, most texels are beyond the tolerance.
            std::vector<translucent_fragment> wrong = fragments;
            std::ranges::reverse(wrong);
            CHECK(compare_blend(*gpu, frame, wrong).beyond > 0.3);
            wrong = fragments;
            std::erase_if(wrong, [n = 0](const translucent_fragment&) mutable { return n++ % 16 == 0; });
            CHECK(compare_blend(*gpu, frame, wrong).beyond > 0.3);
        }
    }
    CHECK(blended >= 2);
    for (const std::string& complaint : gpu->complaints()) FAIL_CHECK(complaint);
}

TEST_CASE("the table is the CPU's, and so are its soft shadows")
{
    const auto gpu = test::device_or_skip();
    if (!gpu) return;
    const renderer::stage scenery = sunny_fence(aspect);
    for (const bool hlsl : {false, true}) {
        CAPTURE(hlsl);
        settings how = small;
        how.hlsl = hlsl;
        const device_comparison comparison(*gpu, scenery, how);
        const auto found = compare_soft(*gpu, scenery, comparison, how);
        REQUIRE(found);
        const soft_comparison& both = *found;
        CHECK(both.wrong_sums == 0);
        check(both.of_look_up, double(both.look_up_tolerance));
        check(both.of_whole, double(both.whole_tolerance));

        // The CPU's shadows are those of the registry's method.
        const auto& method =
            dynamic_cast<const soft_method&>(registry_of<gnomon::evaluation::method>().at("msm4_soft"));
        const renderer::image<std::array<float, 1>> centres;
        const auto map = method.build({comparison.depths(), centres},
                                      soft_light_of(scenery.area(), small.map_resolution, method.widest_search));
        std::vector<std::size_t> pixels;
        const auto where = soft_receivers_of(comparison.seen(), scenery.light, small.map_resolution, pixels);
        REQUIRE(pixels == comparison.where().pixels);
        std::vector<float> intensities(where.size());
        map->intensities(where, intensities);
        for (std::size_t i = 0; i < where.size(); ++i)
            CHECK(std::abs(1 - intensities[i] - found->host.pixels[pixels[i]]) < 1e-4f);

        // A light of half the size has other shadows.
        renderer::stage smaller = scenery;
        smaller.light_size *= 0.5;
        const auto wrong = compare_soft(*gpu, smaller, comparison, how);
        REQUIRE(wrong);
        CHECK(wrong->wrong_sums == 0);
        CHECK(comparison.difference(both.device.frame.visibility, wrong->host, both.whole_tolerance).p99 >
              double(both.whole_tolerance));
    }
    for (const std::string& complaint : gpu->complaints()) FAIL_CHECK(complaint);
}
