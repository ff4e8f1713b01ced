// Single scattering of the example vulkan_shadows, small: each pass has the texels of the CPU within the differences that
// scattering_comparison.hpp derives, pictures have the CPU's visibility, which is that of the registry's method, and the
// validation layer has nothing to say.
#include "evaluation/scattering/scattering_method.hpp"
#include "evaluation/vulkan/scattering_comparison.hpp"
#include "renderer/device.hpp"

#include <cstddef>
#include <numeric>
#include <string>
#include <vector>

using namespace gnomon;
using namespace gnomon::evaluation;

namespace {

// Neither columns nor rows of the rectified map fill all groups and subgroups.
const settings small{.width = 320, .height = 180, .map_resolution = 248};
const renderer::scattering_stage room = renderer::room_stage(16. / 9);
constexpr rectified_options by_row{
    .source = rectified_source::moments, .depth = rectified_depth::cosine, .range_per_row = true};

// As in vulkan_shadows.cpp.
void check(const difference_statistics& d, double tolerance)
{
    CHECK(d.p99 <= tolerance);
    CHECK(d.errors.mean_abs <= 0.1 * tolerance);
    CHECK(d.beyond_inside <= 0.1 * tolerance);
}

void check(const scattering_comparison& one)
{
    CAPTURE(one.name);
    CHECK(one.texels > 10000);
    CHECK(one.nearest.by_more_than_one <= one.texels / 1000);
    CHECK(one.filtered.p99 <= double(one.whole_tolerance) * one.codes);
    CHECK(one.filtered.mean <= 0.1 * double(one.whole_tolerance) * one.codes);
    for (const texel_difference& averages : {one.groups, one.subgroups}) {
        CHECK(averages.texels == one.texels);
        CHECK(averages.largest <= 1);
        CHECK(averages.differing <= one.texels / 10);
    }
    check(one.of_look_up, double(one.look_up_tolerance));
    check(one.of_whole, double(one.whole_tolerance));
}

} // namespace

TEST_CASE("the device scatters light as the CPU does, pass by pass")
{
    const auto gpu = test::device_or_skip();
    if (!gpu) return;
    REQUIRE(gpu->shuffling_lanes() > 0);
    const scattering_view view(room, small);
    for (const bool hlsl : {false, true})
        for (const rectified_options& options : {paper_filtered, by_row}) {
            CAPTURE(hlsl);
            CAPTURE(options.range_per_row);
            settings how = small;
            how.hlsl = hlsl;
            const std::vector<scattering_comparison> all = compare_scattering(*gpu, view, how, options);
            REQUIRE(all.size() == 3);
            for (const scattering_comparison& one : all) check(one);
        }
    for (const std::string& complaint : gpu->complaints()) FAIL_CHECK(complaint);
}

TEST_CASE("the CPU's visibility is that of the registry's methods, and of no other air or camera")
{
    const auto gpu = test::device_or_skip();
    if (!gpu) return;
    const scattering_view view(room, small);
    renderer::scattering_stage thicker = room, aside = room;
    thicker.air.absorption += 0.2f;
    aside.eye.position += 0.1 * room.eye.right;
    const auto visibilities = [&](const std::string& id, const scattering_view& of) {
        const auto& found = dynamic_cast<const scattering_method&>(registry_of<method>().at(id));
        renderer::image<float> result(small.width, small.height);
        found.build(of.scene())->visibilities(of.where, result.pixels);
        return result;
    };
    std::vector<std::size_t> pixels(view.where.size());
    std::iota(pixels.begin(), pixels.end(), std::size_t{0});
    for (const scattering_comparison& one : compare_scattering(*gpu, view, small, paper_filtered)) {
        CAPTURE(one.name);
        const std::string id = paper_method(one.format);
        CHECK(visibilities(id, view).pixels == one.host.pixels);
        for (const renderer::scattering_stage& wrong : {thicker, aside}) {
            const renderer::image<float> host = visibilities(id, scattering_view(wrong, small));
            CHECK(difference_of(one.device.visibility, host, pixels, one.whole_tolerance).p99 >
                  double(one.whole_tolerance));
        }
    }
}
