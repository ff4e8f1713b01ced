// Methods of soft shadows: packs and kernels give the bits of a look-up, and tables darken no lit receiver of the
// driver's scenes.
#include "evaluation/soft/look_up.hpp"
#include "evaluation/soft/soft_scene.hpp"
#include "evaluation/soft/soft_stage.hpp"
#include "evaluation/soft/texel_region.hpp"
#include "support/hostile.hpp"

#include <gnomon/filters/percentage_closer.h>
#include <gnomon/storage/moments4_summed.hpp>
#include <gnomon/storage/moments6_summed.hpp>
#include <gnomon/storage/variance_summed.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <memory>
#include <vector>

using namespace gnomon;
using namespace gnomon::evaluation;

namespace {

constexpr int resolution = 64;

struct maps {
    depth_map samples{resolution, resolution};
    renderer::image<std::array<float, 1>> centres{resolution, resolution};

    // Two surfaces with a border that runs across texels.
    maps()
    {
        test::bit_source bits(1);
        for (std::size_t i = 0; i < samples.pixels.size(); ++i) {
            for (float& z : samples.pixels[i])
                z = float(bits.below(2) ? bits.uniform(-0.5, -0.4) : bits.uniform(0.3, 0.4));
            centres.pixels[i] = {samples.pixels[i][0]};
        }
    }
    [[nodiscard]] soft_depths depths() const { return {samples, centres}; }
};

const soft_light light{.texels = {6, 4}, .map_width = resolution, .map_height = resolution, .widest_search = 9};

std::vector<soft_receiver> some_receivers(std::size_t count)
{
    test::bit_source bits(2);
    std::vector<soft_receiver> result(count);
    for (soft_receiver& r : result)
        r = {float(bits.uniform(-10, resolution + 10)), float(bits.uniform(-10, resolution + 10)),
             float(bits.uniform(-1, 1)), float(bits.uniform(-0.01, 0.01)), float(bits.uniform(-0.01, 0.01))};
    return result;
}

std::vector<const soft_method*> soft_methods_of_registry()
{
    const std::vector<const soft_method*> result = registry_of<method>().all_of<soft_method>();
    REQUIRE(result.size() >= 11);
    return result;
}

// Receivers of a small picture, with the rectangles that percentage-closer soft shadows filter.
struct scene_receivers {
    soft_stage stage;
    soft_light light = stage.light(27);

    explicit scene_receivers(const renderer::stage& scenery)
        : stage(scenery, {.width = 160, .height = 90, .map_resolution = 1024})
    {}
};

} // namespace

TEST_CASE("packs and kernels of soft shadows have the bits of one look-up after the other")
{
    const maps made;
    const std::vector<soft_receiver> where = some_receivers(1000);
    for (const soft_method* m : soft_methods_of_registry()) {
        CAPTURE(m->id);
        const std::unique_ptr<soft_shadow_map> map = m->build(made.depths(), light);
        CHECK(double(map->bytes()) >= m->format.bytes_per_texel * resolution * resolution);
        std::vector<float> expected(where.size());
        map->intensities(where, expected);
        for (const float x : expected) REQUIRE((x >= 0 && x <= 1));
        CHECK(std::ranges::count_if(expected, [](float x) { return x > 0.1f && x < 0.9f; }) > 20); // of penumbrae
        for (const timed_look_up& way : map->timed(where))
            for (const timed_run* run : {&way.kernel, &way.look_up}) {
                CAPTURE(way.lanes);
                std::vector<float> found(where.size(), -1);
                run->run(found);
                REQUIRE(run->receivers > where.size() - std::size_t(way.lanes));
                REQUIRE(std::equal(found.begin(), found.begin() + std::ptrdiff_t(run->receivers), expected.begin()));
            }
    }
}

TEST_CASE("a penumbra of directional and local lights has the width that rays have")
{
    renderer::area_light sun{.map = {.half_extent = {2, 4}, .near_distance = 1, .far_distance = 5}, .size = {0.1, 0.2}};
    const soft_widths<double> seen = soft_light_of(sun, 512, 1e6f).penumbra(0.5, -0.5);
    CHECK(seen.x == doctest::Approx(2 * 2 * std::tan(0.05) * 512 / 4).epsilon(1e-6)); // a distance of 2
    CHECK(seen.y == doctest::Approx(2 * 2 * std::tan(0.1) * 512 / 8).epsilon(1e-6));
    sun.map.kind = renderer::projection::perspective;
    const soft_widths<double> local = soft_light_of(sun, 512, 1e6f).penumbra(0.5, -0.5); // distances 4 and 2
    CHECK(local.x == doctest::Approx(0.1 * 512 / 4 * (1. / 2 - 1. / 4)).epsilon(1e-6));
    CHECK(local.y == doctest::Approx(0.2 * 512 / 8 * (1. / 2 - 1. / 4)).epsilon(1e-6));
}

TEST_CASE("texels under a rectangle have its shares")
{
    double sum = 0, corner = 0;
    int texels = 0;
    visit_texels(summed_area_rectangle<double>{1.25, 2.5, 3, 2.75}, [&](int x, int y, double share) {
        sum += share, ++texels;
        if (x == 1 && y == 2) corner = share;
    });
    CHECK(texels == 2);
    CHECK(sum == doctest::Approx(1));
    CHECK(corner == doctest::Approx(0.75 / 1.75));
    visit_texels(summed_area_rectangle<double>{0, 0, 0, 0},
                 [](int, int, double) { FAIL("an empty rectangle has no texel"); });
}

TEST_CASE_TEMPLATE("no table darkens a receiver by more than its weight", Table, moments4_summed, moments6_summed,
                   variance_summed)
{
    for (const soft_scene* scene : registry_of<scene_entry>().all_of<soft_scene>()) {
        CAPTURE(scene->id);
        const renderer::stage scenery = scene->stage(16. / 9);
        const scene_receivers made(scenery);
        const std::size_t size = 1024, most = 784;
        std::vector<format_texel<Table>> texels(size * size);
        const map_view<const std::array<float, 4>> depths{made.stage.samples.pixels, size, size};
        build_summed_area<Table>(depths, map_view<format_texel<Table>>{texels, size, size}, most);
        double darkest = 0;
        for (const std::vector<soft_receiver>* some : {&made.stage.where, &made.stage.unbiased})
            for (const soft_receiver& r : *some) {
                const summed_area_rectangle<float> search = made.light.search_rectangle(r);
                const map_view<const format_texel<Table>> table{texels, size, size};
                const float blocker = Table::blocker(grid_average<Table>(table, most, search), float(most), r.depth);
                const soft_widths<float> widths = made.light.penumbra(r.depth, blocker);
                const auto rectangle = made.light.clipped(soft_light::filter_rectangle(r, widths));
                const float z_f = biased_depth(r, widths);
                auto truth = percentage_closer_begin(double(z_f));
                const summed_area_rectangle<double> wide{double(rectangle.x0), double(rectangle.y0),
                                                         double(rectangle.x1), double(rectangle.y1)};
                visit_texels(wide, [&](int x, int y, double share) {
                    for (const float z : made.stage.samples(x, y))
                        truth = percentage_closer_add(truth, double(z), share / 4);
                });
                const float found =
                    Table::intensity(rectangle_average<Table>(table, most, rectangle), float(most), z_f);
                darkest = std::max(darkest, double(found) - percentage_closer_end(truth));
            }
        MESSAGE(scene->id, ": the largest excess of ", Table::name, " is ", darkest);
        CHECK(darkest <= Table::darkening(double(most)));
    }
}
