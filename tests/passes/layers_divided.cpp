// Layers that are divided by motion: parts are the surfaces that move unlike, and shadow by their times.
#include "layered_quads.hpp"

#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <cstring>

using namespace gnomon;
using namespace gnomon::test;

namespace {

const layer_settings whole{.layers = 2}, divided{.layers = 2, .division = 8};

/// Mean of numbers in double, and the centre of their extremes.
struct summary {
    double sum = 0, count = 0, least = 9, greatest = -9;
    void add(double x)
    {
        sum += x, ++count;
        least = std::min(least, x), greatest = std::max(greatest, x);
    }
    double mean() const { return sum / count; }
    double centre() const { return 0.5 * (least + greatest); }
};

} // namespace

TEST_CASE("parts are the clusters of motions, with their means and the centres of their depths")
{
    CHECK(rc::check("two clusters, of any size and direction", [](std::uint32_t seed) {
        bit_source bits(seed);
        const float length = float(std::exp2(bits.uniform(1, 8))), turn = float(bits.uniform(0, 6.2));
        const float apart[2] = {length * std::cos(turn), length * std::sin(turn)};
        const float both[2] = {float(bits.uniform(-50, 50)), float(bits.uniform(-50, 50))};
        const double share = bits.uniform(0.1, 0.9);
        const std::size_t each = 1 + bits.below(20); // windows of one batch, and of several
        auto samples = sample_quads({{0, 0}, {}}, 9, 9, each, bits);
        summary x[2], y[2], z[2];
        for (std::size_t i = 0; i < samples.of.size(); ++i) {
            auto& s = samples.of[i];
            const std::size_t part = i < 2 ? i : bits.chance(share);
            s.z = float(bits.uniform(-0.5, 0.5)), s.d_z = 0;
            s.d_x = both[0] + float(part) * apart[0] + length / 50 * float(bits.uniform(-1, 1));
            s.d_y = both[1] + float(part) * apart[1] + length / 50 * float(bits.uniform(-1, 1));
            x[part].add(double(s.d_x)), y[part].add(double(s.d_y)), z[part].add(double(s.z));
        }
        layer_settings settings{.tile = 9, .guard = 9, .texels = 4, .layers = 1, .division = 16};
        const layers_of<layer_variance_float> layers(samples, settings);
        RC_ASSERT(layers.counts.layers == 2u);
        const layer_division& division = layers.clusters[0].divisions[0];
        std::size_t matched = 0; // the axis may point from either to the other
        for (std::size_t k = 0; k < 2; ++k)
            for (std::size_t part = 0; part < 2; ++part) {
                const layer_grid<float>& g = layers.grids[k];
                const double off = std::hypot(double(g.axis_x * g.motion) - x[part].mean(),
                                              double(g.axis_y * g.motion) - y[part].mean());
                if (off > 0.1 * double(length)) continue;
                ++matched;
                RC_ASSERT(off < 1e-4 * (100 + double(length)));
                RC_ASSERT(std::abs(double(division.centres[k]) - z[part].centre()) < 1e-6);
            }
        RC_ASSERT(matched == 2u);
        settings.division = 64; // as many as there are bins
        RC_ASSERT(layers_of<layer_variance_float>(samples, settings).counts.layers == 1u);
    }));
}

TEST_CASE("layers of one motion are whole, bit for bit")
{
    bit_source bits(1);
    const quad_scene scene{{0.8f, 0}, {{16, 16, 6, 9, -0.2f, 20, 3, 0}}};
    const auto samples = sample_quads(scene, 32, 32, 4, bits);
    const layers_of<layer_variance_float> a(samples, layer_settings{}), b(samples, {.division = 1});
    REQUIRE(a.texels.size() == b.texels.size());
    CHECK(std::memcmp(a.texels.data(), b.texels.data(), a.texels.size() * sizeof a.texels[0]) == 0);
}

TEST_CASE("rectangles that pass one another in one layer shadow the floor, and the farther of them, by their times")
{
    bit_source bits(2);
    for (const float near : {-0.2f, -0.26f}) { // at one depth, and one before the other
        const quad_scene scene{{0.8f, 0}, {{24, 24, 5, 20, near, 40, 0, 0}, {24, 24, 5, 20, -0.2f, -40, 0, 0}}};
        double floor[2] = {}, far[2] = {}, on_floor = 0, on_far = 0;
        for (int seed = 0; seed < 4; ++seed) {
            const auto samples = sample_quads(scene, 48, 48, 4, bits);
            const layers_of<layer_variance_float> layers[2] = {{samples, whole}, {samples, divided}};
            CHECK(layers[1].counts.layers > layers[0].counts.layers + 20);
            for (int i = 0; i < 1000; ++i) {
                const float x = float(bits.uniform(14, 34)), y = float(bits.uniform(20, 28));
                auto r = still_receiver(x, y, 0.7f, float(bits.uniform(0, 1)), bits);
                const auto covered = [&](float z) {
                    double sum = 0;
                    for (int k = 0; k < 32; ++k)
                        sum += scene.is_covered(x, y, r.t0 + (float(k) + 0.5f) / 32 * (r.t1 - r.t0), z);
                    return sum / 32;
                };
                const auto add = [&](double(&to)[2], double expected) {
                    for (int k : {0, 1}) to[k] += std::pow(double(layers[k].intensity(r)) - expected, 2);
                };
                add(floor, covered(0.7f)), ++on_floor;
                if (!scene.quads[1].covers(x, y, r.t)) continue;
                r.z = -0.2f;
                r.x0 = r.x1 = x, r.t0 = r.t1 = r.t;
                add(far, scene.is_covered(x, y, r.t, -0.21f)), ++on_far;
            }
        }
        INFO("rms on the floor " << std::sqrt(floor[0] / on_floor) << ", divided " << std::sqrt(floor[1] / on_floor)
                                 << "; on the farther " << std::sqrt(far[0] / on_far) << ", divided "
                                 << std::sqrt(far[1] / on_far));
        CHECK(floor[1] < 0.2 * floor[0]);
        CHECK(far[1] <= 0.5 * far[0]); // nothing at one depth
    }
}
