// Neighbouring triangles in motion leave no crack between them: a texel sees one of them until the next one covers it.
#include "moving_boxes.hpp"
#include "renderer/raster/moving_rasterizer.hpp"
#include "renderer/raster/moving_tiles.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <vector>

using namespace gnomon;
using namespace gnomon::renderer;
using namespace gnomon::test;

namespace {

// The mean time for which two neighbours may cover a texel together: both are widened by 2^-19 of their size in a tile,
// some 20 texels, and move by one texel or more in the shutter interval.
constexpr double shared_time = 2 * 20 * 0x1p-19;

} // namespace

TEST_CASE("neighbours leave no crack: a texel sees one triangle of the ground until the next one covers it")
{
    const moving_scene world = moving_boxes(3, 0);
    const moving_camera light{light_of(world, true).open, {0.7, 0.4, -0.3}};
    range_rasterizer rasterize;
    const range_lists& lists = rasterize(world, light, 256, 256);
    int shared = 0;
    double together = 0;
    for (std::size_t i = 0; i < 256 * 256; ++i) {
        const auto list = lists.map()(i % 256, i / 256);
        REQUIRE(list.size() <= 2);
        if (list.size() < 2) continue;
        ++shared;
        const float begin = std::max(list[0].t0, list[1].t0), end = std::min(list[0].t1, list[1].t1);
        REQUIRE(begin <= end);
        together += double(end - begin);
    }
    CHECK(shared > 100);
    CHECK(together < shared_time * shared);
}

// A sheet that is larger than the picture, across the light's axis: one half is translated, the other one creased.
TEST_CASE("neighbours leave no crack where one is translated and the other is not")
{
    constexpr int side = 9, size = 128;
    bit_source bits(11);
    const auto real = [&] { return static_cast<float>(bits.uniform(-0.3, 0.3)); };
    mesh open;
    std::vector<glm::vec3> closing;
    for (int z = 0; z < side; ++z)
        for (int x = 0; x < side; ++x) {
            const glm::vec3 at(float(x - side / 2), 0, float(z - side / 2));
            open.positions.push_back(at);
            closing.push_back(at + (x < side / 2 ? glm::vec3(0.3f, 0.1f, -0.2f) : glm::vec3(real(), 0.1f, real())));
        }
    for (unsigned z = 0; z + 1 < side; ++z)
        for (unsigned x = 0; x + 1 < side; ++x) {
            const unsigned i = z * side + x;
            open.triangles.push_back({i, i + 1, i + side});
            open.triangles.push_back({i + 1, i + side + 1, i + side});
        }
    const moving_scene world{{"sheet", {open}}, {closing}};
    const std::array<glm::vec3, 2> seen{glm::vec3(-2, -0.5f, -2), glm::vec3(2, 0.5f, 2)};
    const moving_camera light{perspective_view_from({0.2, 7, 0.1}, {0, 0, 0}, seen, glm::radians(30.0), 1)};

    int linear = 0, mixed = 0;
    const tiled_triangles scenery(world, light, size, size, faces::both);
    for (std::size_t tile = 0; tile < scenery.tiles(); ++tile)
        scenery.for_each(tile, [&](const moving_setup& s) {
            linear += s.linear;
            mixed += glm::any(s.linear_edges) && !s.linear;
        });
    CHECK(linear > 0);
    CHECK(mixed > 0);

    range_rasterizer rasterize;
    const range_lists& lists = rasterize(world, light, size, size);
    std::size_t shared = 0;
    double together = 0;
    for (std::size_t i = 0; i < std::size_t(size) * size; ++i) {
        const auto list = lists.map()(i % size, i / size);
        std::vector<depth_time_range<float>> sorted(list.begin(), list.end());
        std::ranges::sort(sorted, {}, &depth_time_range<float>::t0);
        REQUIRE(!sorted.empty());
        REQUIRE(sorted.front().t0 == 0);
        REQUIRE(sorted.back().t1 == 1);
        for (std::size_t k = 1; k < sorted.size(); ++k) {
            REQUIRE(sorted[k].t0 <= sorted[k - 1].t1);
            together += double(sorted[k - 1].t1 - sorted[k].t0);
        }
        shared += sorted.size() - 1;
    }
    CHECK(shared > std::size_t(size) * size / 4);
    CHECK(together < shared_time * double(shared));
}
