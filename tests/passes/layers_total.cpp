// Layered maps of any samples: intensities from 0 to 1, lit where nothing is known, the same bits as kernels; tiles at random
// and blocks at the border of windows; shapes that do not fit.
#include "layered_quads.hpp"
#include "support/effort.hpp"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <limits>
#include <stdexcept>

using namespace gnomon;
using namespace gnomon::test;

namespace {

constexpr float none = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
const std::array<layer_settings, 4> all_settings{{{}, {8, 16, 16}, {4, 4, 1, 4}, {5, 11, 2, 3, false, false, 1}}};

layer_receiver<float> any_receiver(hostile_source<float>& source, bit_source& bits)
{
    layer_receiver<float> r = still_receiver(float(bits.uniform(-2, 22)), float(bits.uniform(-2, 20)),
                                             float(bits.uniform(-1, 1)), float(bits.uniform(0, 1)), bits);
    const auto a = source.draw();
    for (std::size_t k = 0; k < 3; ++k) // a few numbers of any kind
        if (bits.chance(0.6))
            std::memcpy(reinterpret_cast<char*>(&r) + bits.below(15) * sizeof(float), &a[k], sizeof(float));
    return r;
}

} // namespace

TEST_CASE_TEMPLATE("any numbers give intensities from 0 to 1", Format, layer_variance_float, layer_variance_half,
                   layer_moments4_float, layer_exponential_float)
{
    hostile_source<float> source(1);
    bit_source bits(1);
    const quad_scene scene{{0.8f, 0}, {{10, 9, 5, 4, -0.2f, 9, 3, 0.1f}}};
    for (std::int64_t i = 0; i < effort(400); ++i) {
        auto samples = sample_quads(scene, 20, 18, 3, bits);
        const double share = bits.uniform(0, 1);
        for (auto& s : samples.of)
            if (bits.chance(share * share)) {
                const auto a = source.draw(), b = source.draw();
                const std::array<float, 8> any{a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3]};
                std::memcpy(reinterpret_cast<char*>(&s) + bits.below(8) * sizeof(float), &any, sizeof(float));
                if (bits.chance(0.2)) std::memcpy(&s, &any, sizeof s);
            }
        const layers_of<Format> layers(samples, all_settings[bits.below(all_settings.size())]);
        for (int k = 0; k < 40; ++k) {
            const layer_look_up look_up{layer_tiles(bits.below(3)), bits.chance(0.5)};
            const float shadow = layers.intensity(any_receiver(source, bits), look_up);
            REQUIRE((0 <= shadow && shadow <= 1));
        }
    }
}

TEST_CASE("samples that tell nothing shadow nothing")
{
    bit_source bits(2);
    hostile_source<float> source(2);
    const auto lit_everywhere = [&](const sampled_quads& samples) {
        for (const layer_settings& settings : all_settings) {
            const layers_of<layer_variance_float> layers(samples, settings);
            for (int k = 0; k < 200; ++k) {
                layer_receiver<float> r = still_receiver(float(bits.uniform(0, 20)), float(bits.uniform(0, 18)), 0.7f,
                                                         float(bits.uniform(0, 1)), bits);
                REQUIRE(layers.intensity(r, {layer_tiles(k % 3)}) == 0);
            }
        }
    };
    const auto every = [&](auto change) {
        auto samples = sample_quads({{-0.5f, 0}, {}}, 20, 18, 2, bits);
        for (auto& s : samples.of) change(s);
        return samples;
    };
    lit_everywhere(every([](auto& s) { s.id = -1; }));
    lit_everywhere(every([](auto& s) { s.z = none; }));
    lit_everywhere(every([](auto& s) { s.d_z = none; }));
    lit_everywhere(every([](auto& s) { s.x = inf, s.d_x = 3; })); // beside every window
    lit_everywhere(every([](auto& s) { s.t = none, s.d_x = 3; }));
    for (const float unknown : {none, inf, -inf, 1e9f, 70000.0f}) { // no place is known, so none is behind a receiver
        lit_everywhere(every([&](auto& s) { s.d_x = unknown; }));
        lit_everywhere(every([&](auto& s) { s.d_y = unknown, s.z = 0.5f + 0.4f * s.t; }));
    }
    lit_everywhere(every([](auto& s) { s = {none, none, none, none, none, none, none, none}; }));
}

TEST_CASE_TEMPLATE("receivers of unknown place, depth, time or footprint are lit", Format, layer_variance_float,
                   layer_moments4_float, layer_exponential_float)
{
    bit_source bits(11);
    for (const float d : {0.0f, 3.0f}) { // in the plain map, and in layers
        auto samples = sample_quads({{-0.5f, 0}, {}}, 20, 18, 2, bits);
        for (auto& s : samples.of) s.d_x = d;
        const layers_of<Format> layers(samples, layer_settings{});
        for (std::size_t k = 0; k < 15; ++k) {
            layer_receiver<float> r = still_receiver(10.3f, 9.2f, 0.5f, 0.4f, bits);
            std::memcpy(reinterpret_cast<char*>(&r) + k * sizeof(float), &none, sizeof(float));
            CHECK((layers.intensity(r, {layer_tiles(k % 3)}) == 0) == (k < 12)); // not by slope or random numbers
        }
    }
}

TEST_CASE("one sample is found from everywhere in its tile")
{
    bit_source bits(3);
    auto samples = sample_quads({{0, 0}, {}}, 12, 12, 1, bits);
    for (auto& s : samples.of) s.z = none;
    samples.of[6 * 12 + 6] = {6.5f, 6.5f, 0.5f, -0.5f, 3, 0, 0, 1};
    const layers_of<layer_variance_float> layers(samples, layer_settings{});
    CHECK(layers.counts.layers == 9); // one in each window that holds the sample
    for (int k = 0; k < 1000; ++k)    // holes take the next level that has a sample
        REQUIRE(layers.intensity(still_receiver(float(bits.uniform(0, 12)), float(bits.uniform(0, 12)), 0.5f,
                                                float(bits.uniform(0, 1)), bits)) == 1);
}

TEST_CASE("motions that cancel, or are far longer than the window, keep the shadow of what covers all")
{
    bit_source bits(4);
    for (const float length : {1.0f, 30.0f, 4000.0f, 60000.0f})
        for (const bool cancel : {false, true}) {
            auto samples = sample_quads({{-0.5f, 0}, {}}, 24, 24, 4, bits);
            for (auto& s : samples.of) s.d_x = cancel && bits.chance(0.5) ? -length : length;
            for (const layer_settings& settings : all_settings) {
                const layers_of<layer_variance_float> layers(samples, settings);
                for (int k = 0; k < 300; ++k) {
                    const auto r = still_receiver(float(bits.uniform(0, 24)), float(bits.uniform(0, 24)), 0.5f,
                                                  float(bits.uniform(0, 1)), bits);
                    REQUIRE(layers.intensity(r, {layer_tiles(k % 3), k % 2 == 0}) > 0.9999f);
                }
            }
        }
}

TEST_CASE_TEMPLATE("a level surface that moves by any distance, in depth too, does not shadow itself", Format,
                   layer_variance_float, layer_variance_half, layer_moments4_float, layer_exponential_float)
{
    bit_source bits(6);
    for (std::int64_t i = 0; i < effort(200); ++i) {
        const auto any = [&](double least, double most) {
            return float(std::exp2(bits.uniform(least, most)) * (bits.chance(0.5) ? 1 : -1));
        };
        const float d_x = any(-22, 20), d_y = any(-22, 20), d_z = bits.chance(0.2) ? 0 : any(-20, 15);
        // Depth 0 is passed at time `level`. All samples and receivers see the surface between the planes.
        const float level = float(bits.uniform(0, 1)), reach = std::min(0.9f / std::abs(d_z), 1.0f);
        const auto time = [&] { return std::clamp(level + reach * float(bits.uniform(-1, 1)), 0.0f, 1.0f); };
        auto samples = sample_quads({{0, 0}, {}}, 14, 11, 3, bits);
        for (auto& s : samples.of) s.t = time(), s.z = (s.t - level) * d_z, s.d_x = d_x, s.d_y = d_y, s.d_z = d_z;
        const layers_of<Format> layers(samples, all_settings[bits.below(all_settings.size())]);
        for (int k = 0; k < 40; ++k) {
            const float t = time();
            const auto r =
                still_receiver(float(bits.uniform(0, 14)), float(bits.uniform(0, 11)), (t - level) * d_z, t, bits);
            const float shadow = layers.intensity(r, {layer_tiles(k % 3), bits.chance(0.5)});
            INFO(Format::id << ": " << d_x << ", " << d_y << ", " << d_z << " from " << level << " on, at " << t);
            REQUIRE(shadow <= 1e-3f);
        }
    }
}

TEST_CASE("the mean of random tiles is the blend of tiles")
{
    bit_source bits(8);
    auto samples = sample_quads({{0, 0}, {}}, 24, 24, 2, bits);
    for (auto& s : samples.of) s.z = float(bits.uniform(-0.9, 0.9)), s.d_x = float(bits.uniform(0, 4));
    const layers_of<layer_variance_float> layers(samples, {});
    double differing = 0;
    for (int k = 0; k < 100; ++k) {
        auto r = still_receiver(float(bits.uniform(0, 24)), float(bits.uniform(0, 24)), 0.3f, 0.5f, bits);
        constexpr int n = 32; // weights are between two of n shares
        double mean = 0;
        for (int i = 0; i < n * n; ++i) {
            r.random_x = (float(i % n) + 0.5f) / n, r.random_y = (float(i) / n + 0.5f) / n;
            mean += double(layers.intensity(r, {layer_tiles::random})) / (n * n);
        }
        REQUIRE(std::abs(mean - double(layers.intensity(r, {layer_tiles::blended}))) <= 2.0 / n);
        differing += std::abs(mean - double(layers.intensity(r, {layer_tiles::own})));
    }
    CHECK(differing > 2);
}

TEST_CASE("plain tiles look up blocks that only their windows reach")
{
    bit_source bits(9);
    auto samples = sample_quads({{-0.5f, 0}, {}}, 64, 32, 4, bits);
    for (auto& s : samples.of) {
        if (s.x < 32) s = stochastic_background(s.x, s.y, s.t); // block 0
        if (s.x >= 36) s.d_x = 1;                               // no tile of block 1 is plain
    }
    const layers_of<layer_variance_float> layers(samples, {});
    CHECK(layers.counts.blocks == 2);
    for (int k = 0; k < 100; ++k) {
        auto r = still_receiver(31.9f, float(bits.uniform(6, 26)), 0.5f, 0.5f, bits);
        r.x0 -= 3.5f, r.x1 += 3.5f;
        REQUIRE(layers.intensity(r, {layer_tiles::own}) == doctest::Approx(0.5).epsilon(0.1));
    }
}

TEST_CASE("clusters are those of the kernels")
{
    CHECK(rc::check("cuts, and counts of layers", [](std::uint32_t seed) {
        bit_source bits(seed);
        hostile_source<float> source(seed);
        auto samples = sample_quads({{0.8f, 0}, {}}, 9, 7, 3, bits);
        const std::size_t depths = 1 + bits.below(7);
        for (auto& s : samples.of) {
            s.z = float(bits.below(depths)) / 7 - float(bits.uniform(0, 0.1)), s.d_z = float(bits.uniform(-0.1, 0.1));
            if (bits.chance(0.1)) s.id = -1;
            if (bits.chance(0.05)) s.z = source.draw()[0];
        }
        const layer_settings settings{9, 9, 4, 1 + bits.below(4)};
        std::array<tile_clusters, 1> clusters;
        layer_cluster(samples, settings, clusters, {0, 1});
        layer_window<float> window = layer_window_begin(layer_middle_depth(samples.of[0]));
        for (const auto& s : samples.of) window = layer_window_add(window, layer_middle_depth(s));
        std::array<float, 64> occupied{};
        for (const auto& s : samples.of) {
            const float bin = layer_bin_of(layer_middle_depth(s), window);
            if (bin >= 0) occupied[std::size_t(bin)] = 1;
        }
        layer_runs<float> runs = layer_cuts_begin(window);
        for (const float o : occupied) runs = layer_cuts_add(runs, o);
        const layer_cuts<float> cuts = layer_cuts_end(runs, float(settings.layers));
        RC_ASSERT(std::memcmp(&cuts, &clusters[0].cuts, sizeof cuts) == 0);
        float most = -1;
        for (const auto& s : samples.of) {
            const float at = layer_of(layer_middle_depth(s), cuts);
            if (at < 4) most = std::max(most, at);
        }
        RC_ASSERT(clusters[0].layers == std::uint32_t(most + 1));
    }));
}

TEST_CASE("grids are those of the kernels, but for the order of sums")
{
    CHECK(rc::check("motion, spread and depths", [](std::uint32_t seed) {
        bit_source bits(seed);
        const std::size_t each = 1 + bits.below(20); // windows of one batch, and of several
        auto samples = sample_quads({{0, 0}, {}}, 9, 9, each, bits);
        for (auto& s : samples.of) {
            s.d_x = float(bits.uniform(-9, 40)), s.d_y = float(bits.uniform(-9, 9));
            s.z = float(bits.uniform(-0.5, 0.5)), s.d_z = float(bits.uniform(-0.2, 0.3));
            if (bits.chance(0.1)) s.id = -1;
            if (bits.chance(0.05)) s.d_y = none;
        }
        const layer_settings settings{9, 9, 4, 1};
        const layers_of<layer_variance_float> layers(samples, settings);
        layer_motion_sums<float> sums = layer_motion_begin(samples.of[0]);
        for (const auto& s : samples.of) sums = layer_motion_add(sums, s, layer_middle_depth(s));
        const layer_grid<float> expected = layer_grid_make(layer_motion_end(sums), 9.0f, 4.0f);
        const auto a = gnomon_bit_cast<std::array<float, 11>>(expected);
        const auto b = gnomon_bit_cast<std::array<float, 11>>(layers.grids.at(0));
        for (std::size_t k = 0; k < a.size(); ++k) RC_ASSERT(std::abs(a[k] - b[k]) < 2e-4f * (1 + std::abs(a[k])));
    }));
}

#if defined(__cpp_exceptions)
TEST_CASE("shapes that do not fit are refused before anything is written")
{
    bit_source bits(5);
    using format = layer_variance_float;
    const auto samples = sample_quads({{0.8f, 0}, {{9, 9, 4, 4, 0, 3, 0, 0}}}, 20, 18, 2, bits);
    layers_of<format> layers(samples, layer_settings{});
    const auto before = layers.texels;
    const auto refused = [&](auto change) {
        auto map = layers.map();
        row_range rows{0, 5};
        std::span<const tile_clusters> clusters = layers.clusters;
        sample_map<float> from = samples;
        change(map, rows, clusters, from);
        CHECK_THROWS_AS(layer_accumulate<format>(from, clusters, map, rows), std::invalid_argument);
        CHECK(layers.texels == before);
    };
    refused([](auto& map, auto&, auto&, auto&) { map.width = 24; });
    refused([](auto& map, auto&, auto&, auto&) { map.settings.texels = 6; });
    refused([](auto& map, auto&, auto&, auto&) { map.settings.guard = 3; });
    refused([](auto& map, auto&, auto&, auto&) { map.settings.guard = 13; });
    refused([](auto& map, auto&, auto&, auto&) { map.settings.guard = 300; });
    refused([](auto& map, auto&, auto&, auto&) { map.settings.tile = 0; });
    refused([](auto& map, auto&, auto&, auto&) { map.settings.layers = 0; });
    refused([](auto& map, auto&, auto&, auto&) { map.settings.layers = 5; });
    refused([](auto& map, auto&, auto&, auto&) { map.first = map.first.first(7); });
    refused([](auto& map, auto&, auto&, auto&) { map.grids = map.grids.first(1); });
    refused([](auto& map, auto&, auto&, auto&) { map.texels = map.texels.first(100); });
    refused([](auto&, auto& rows, auto&, auto&) { rows.last = 6; });
    refused([](auto&, auto& rows, auto&, auto&) { rows.first = 6; });
    refused([](auto&, auto&, auto& clusters, auto&) { clusters = clusters.first(4); });
    refused([](auto&, auto&, auto&, auto& from) { from.samples = 3; });
    refused([](auto&, auto&, auto&, auto& from) { from.of = from.of.first(5); });
    auto others = layers.clusters;
    others[12].layers = 4;
    refused([&](auto&, auto&, auto& clusters, auto&) { clusters = others; });
    CHECK_THROWS_AS(layer_mips<format>(layers.map(), {0, 6}), std::invalid_argument);
    CHECK_THROWS_AS(layer_cluster(samples, layer_settings{}, layers.clusters, {0, 6}), std::invalid_argument);
    CHECK_THROWS_AS(layer_allocate(layer_settings{}, layers.clusters, 20, 18, layers.blocks, layers.blocks),
                    std::invalid_argument);
}
#endif
