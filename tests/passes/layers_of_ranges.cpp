// Layered maps of samples that come from exact ranges: regular instants in place of random ones.
#include "layered_quads.hpp"

#include <gnomon/passes/range/samples.hpp>

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <limits>
#include <stdexcept>
#include <utility>

using namespace gnomon;
using namespace gnomon::test;

namespace {

/// The ranges of a scene at texel centres, not resolved, with the number of the rectangle as id.
struct ranges_of_quads {
    std::size_t width, height;
    std::vector<std::uint32_t> first;
    std::vector<depth_time_range<float>> ranges;

    ranges_of_quads(const quad_scene& scene, std::size_t w, std::size_t h)
        : width(w), height(h), first(range_map<float>::texels(w, h) + 1)
    {
        std::vector<std::uint32_t> texels;
        std::vector<depth_time_range<float>> loose;
        for (std::size_t y = 0; y < h; ++y)
            for (std::size_t x = 0; x < w; ++x) {
                const float at_x = float(x) + 0.5f, at_y = float(y) + 0.5f;
                const auto add = [&](float t0, float t1, float z0, float z1, float id) {
                    texels.push_back(std::uint32_t(range_map<float>::texel(w, x, y)));
                    loose.push_back({t0, t1, z0, z1, id});
                };
                const float floor = scene.floor.z + scene.floor.slope * at_x;
                add(0, 1, floor, floor, float(scene.quads.size()));
                for (std::size_t k = 0; k < scene.quads.size(); ++k) {
                    const moving_quad& q = scene.quads[k];
                    float t0 = 0, t1 = 1; // while |at - centre| < half extent along both axes
                    const auto cut = [&](float offset, float half, float d) {
                        if (d == 0) {
                            if (!(std::abs(offset) < half)) t1 = 0;
                            return;
                        }
                        const float a = (offset - half) / d + 0.5f, b = (offset + half) / d + 0.5f;
                        t0 = std::max(t0, std::min(a, b)), t1 = std::min(t1, std::max(a, b));
                    };
                    cut(at_x - q.x, q.a, q.d_x), cut(at_y - q.y, q.b, q.d_y);
                    if (t0 < t1) add(t0, t1, q.depth(t0), q.depth(t1), float(k));
                }
            }
        ranges.resize(loose.size());
        sort_into_lists<float>(texels, loose, first, ranges);
    }
    range_map<float> map() const { return {width, height, first, ranges}; }
};

sampled_quads samples_of_ranges(const quad_scene& scene, std::size_t width, std::size_t height, std::size_t each)
{
    const ranges_of_quads ranges(scene, width, height);
    sampled_quads s{width, height, each, std::vector<stochastic_sample<float>>(width * height * each)};
    const auto motion = [&](float id, float, float, float) -> triangle_motion<float> {
        if (id >= float(scene.quads.size())) return {0, 0, 0};
        const moving_quad& q = scene.quads[std::size_t(id)];
        return {q.d_x, q.d_y, q.d_z};
    };
    sample_ranges<range_map<float>, float>(ranges.map(), each, motion, s.of, {0, height});
    return s;
}

const layer_settings quality{.centres = true}, speed{.tile = 8, .guard = 16, .texels = 16, .centres = true};

} // namespace

TEST_CASE("samples of ranges are what the scene shows at their places and times")
{
    const quad_scene scene{{0.8f, 0.001f}, {{20, 20, 6, 5, -0.2f, 9, 3, 0.1f}, {26, 22, 7, 7, 0.3f, -5, 4, 0}}};
    const sampled_quads samples = samples_of_ranges(scene, 48, 40, 5);
    std::size_t on_quads = 0;
    for (std::size_t i = 0; i < samples.of.size(); ++i) {
        const stochastic_sample<float>& s = samples.of[i];
        REQUIRE(slice_of(s.t, 5.0f) == float(i % 5));
        REQUIRE(s.x == float(i / 5 % 48) + 0.5f);
        const stochastic_sample<float> expected = scene.sample(s.x, s.y, s.t);
        REQUIRE(s.id == expected.id);
        REQUIRE(s.z == doctest::Approx(double(expected.z)).epsilon(1e-4));
        REQUIRE(s.d_x == expected.d_x);
        on_quads += s.id < 2;
    }
    CHECK(on_quads > 500);
}

TEST_CASE("layers of ranges are less noisy than layers of random samples, and unbiased")
{
    bit_source bits(1);
    for (const layer_settings& settings : {quality, speed})
        for (const moving_quad& quad : {moving_quad{32, 32, 6, 9, -0.2f, 60, 0, 0},
                                        {32, 32, 6, 9, -0.2f, 0, 72, 0.05f},
                                        {32, 32, 6, 9, -0.2f, 54, 27, -0.3f}}) {
            const quad_scene scene{{0.8f, 0}, {quad}};
            const layers_of<layer_variance_float> exact(samples_of_ranges(scene, 64, 64, 4), settings);
            double mean = 0, of_exact = 0, of_random = 0;
            for (int seed = 0; seed < 8; ++seed) {
                const layers_of<layer_variance_float> random(sample_quads(scene, 64, 64, 4, bits), settings);
                for (int i = 0; i < 64; ++i) { // means over the shutter interval at one place
                    const float x = float(bits.uniform(30, 34)), y = float(bits.uniform(30, 34));
                    double a = 0, b = 0, covered = 0;
                    for (int k = 0; k < 64; ++k) {
                        const float t = (float(k) + float(bits.uniform(0, 1))) / 64;
                        const auto r = still_receiver(x, y, 0.7f, t, bits);
                        a += double(exact.intensity(r)) / 64, b += double(random.intensity(r)) / 64;
                        covered += double(scene.is_covered(x, y, t, 0.7f)) / 64;
                    }
                    mean += a - covered, of_exact += (a - covered) * (a - covered);
                    of_random += (b - covered) * (b - covered);
                }
            }
            INFO(quad.d_x << ": bias " << mean / 512 << ", rms " << std::sqrt(of_exact / 512) << ", of random samples "
                          << std::sqrt(of_random / 512));
            CHECK(std::abs(mean / 512) < 0.015);
            CHECK(of_exact < 0.5 * of_random);
        }
}

TEST_CASE("ranges of no surface and of NaN are not sampled, those of several are a surface without motion")
{
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    const auto id_and_depth = [](std::vector<depth_time_range<float>> list) {
        std::vector<std::uint32_t> first(range_map<float>::texels(1, 1) + 1, std::uint32_t(list.size()));
        first[0] = 0;
        std::vector<stochastic_sample<float>> samples(3);
        const auto moving = [](float, float, float, float) { return triangle_motion<float>{1, 2, 3}; };
        sample_ranges<range_map<float>, float>({1, 1, first, list}, 3, moving, samples, {0, 1});
        for (const auto& s : samples) CHECK((s.id == samples[0].id && s.d_x == (s.id > 0 ? 1 : 0)));
        return std::pair(samples[0].id, samples[0].z);
    };
    const depth_time_range<float> surface{0, 1, 0.25f, 0.25f, 7}, farther{0, 1, 0.5f, 0.5f, 8};
    CHECK(id_and_depth({}) == std::pair(float(stochastic_nothing), 1.f));
    CHECK(id_and_depth({{0, 1, 1, 1, float(range_nothing)}}) == std::pair(float(stochastic_nothing), 1.f));
    CHECK(id_and_depth({{0, 1, nan, nan, 3}}) == std::pair(float(stochastic_nothing), 1.f));
    CHECK(id_and_depth({{0, 1, nan, 0, 3}, farther, surface}) == std::pair(7.f, 0.25f));
    CHECK(id_and_depth({{0, nan, 0, 0, 3}, surface, farther}) == std::pair(7.f, 0.25f));
    CHECK(id_and_depth({{0, 1, 0, 0, float(range_mixed)}, surface}) == std::pair(0.f, 0.f));
}

TEST_CASE("a tilted plane at texel centres is one layer, and what is before it another")
{
    CHECK(rc::check("layers of a plane and of a rectangle", [](std::uint32_t seed) {
        bit_source bits(seed);
        const float slope_x = float(bits.uniform(-0.02, 0.02)), slope_y = float(bits.uniform(-0.02, 0.02));
        const bool some = bits.chance(0.5);
        sampled_quads samples{20, 17, 2, {}};
        for (std::size_t i = 0; i < 20 * 17 * 2; ++i) {
            const float x = float(i / 2 % 20) + 0.5f, y = float(i / 40) + 0.5f;
            const bool before = some && x < 9;
            samples.of.push_back({x, y, 0.25f + 0.5f * float(i % 2),
                                  (before ? -0.9f : 0.3f) + slope_x * (x - 10) + slope_y * (y - 8), 0, 0, 0, 1});
        }
        for (layer_settings settings : {quality, speed}) {
            std::array<tile_clusters, 25> clusters;
            const std::size_t across = tiles_along(20, settings.tile), rows = tiles_along(17, settings.tile);
            layer_cluster(samples, settings, std::span(clusters).first(across * rows), {0, rows});
            for (std::size_t i = 0; i < across * rows; ++i) {
                const auto w = detail::window_around(samples, settings, i % across, i / across);
                RC_ASSERT(clusters[i].layers == (some && w.x0 < 9 && w.x1 > 9 ? 2u : 1u));
            }
        }
    }));
    sampled_quads samples{12, 12, 1, {}};
    for (std::size_t i = 0; i < 144; ++i)
        samples.of.push_back({float(i % 12) + 0.5f, float(i / 12) + 0.5f, 0.5f, 0.01f * float(i % 12), 0, 0, 0, 1});
    std::array<tile_clusters, 9> clusters;
    layer_cluster(samples, {}, clusters, {0, 3});
    CHECK(clusters[4].layers == 4); // as if they were anywhere in their texels
}

#if defined(__cpp_exceptions)
TEST_CASE("samples that do not fit a map of ranges are refused")
{
    const ranges_of_quads ranges({{0.8f, 0}, {}}, 5, 4);
    std::vector<stochastic_sample<float>> samples(40);
    const auto still = [](float, float, float, float) { return triangle_motion<float>{0, 0, 0}; };
    const auto refused = [&](std::size_t each, std::size_t size, row_range rows) {
        CHECK_THROWS_AS(
            (sample_ranges<range_map<float>, float>(ranges.map(), each, still, std::span(samples).first(size), rows)),
            std::invalid_argument);
        CHECK(samples[0].z == 0);
    };
    refused(0, 0, {0, 4});
    refused(2, 39, {0, 4});
    refused(2, 40, {0, 5});
    refused(2, 40, {3, 2});
}
#endif
