// The reference that shadows of translucent occluders are compared with, and fragments that are drawn by chance.
#include "evaluation/core/percentage_closer.hpp"
#include "evaluation/translucent/methods/stochastic.hpp"
#include "evaluation/translucent/stacks.hpp"
#include "evaluation/translucent/view.hpp"
#include "renderer/scene/translucent_stage.hpp"

#include <gnomon/passes/blur.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

using namespace gnomon;
using namespace gnomon::evaluation;

namespace {

constexpr int resolution = 128;
const auto taps = gaussian_weights();

const renderer::stage& scenery()
{
    static const renderer::stage result = renderer::translucent_stage(16. / 9);
    return result;
}

const translucent_occluders& occluders()
{
    static const translucent_occluders result(scenery().world, scenery().light, resolution);
    return result;
}

// Calls visit(x, y, fragments) for texels in whose samples all opaque surfaces are behind the fragments.
void visit_stacks(auto&& visit)
{
    for (int y = 0; y < resolution; ++y)
        for (int x = 0; x < resolution; ++x) {
            const std::span<const renderer::fragment> fragments = occluders().translucent(x, y);
            if (fragments.empty()) continue;
            const auto& opaque = occluders().opaque(x, y);
            if (*std::ranges::min_element(opaque) > fragments.front().depth) visit(x, y, fragments);
        }
}

} // namespace

TEST_CASE("a texel's shadow is what the product of all transmittances leaves out")
{
    const texel_stacks stacks(occluders());
    int stacked = 0;
    visit_stacks([&](int x, int y, std::span<const renderer::fragment> fragments) {
        stacked += fragments.size() > 5;
        of_colours transmittance(1);
        for (std::size_t i = fragments.size(); i-- > 0;) { // from the nearest on
            const of_colours taken = stacks.intensity(x, y, fragments[i].depth);
            for (int c = 0; c < 4; ++c) CHECK(std::abs(1 - transmittance[c] - taken[c]) < 1e-6);
            const glm::vec3& a = fragments[i].opacity;
            transmittance *= of_colours(1) - of_colours((a.r + a.g + a.b) / 3, a.r, a.g, a.b);
        }
        CHECK(std::abs(1 - stacks.intensity(x, y, 2).x) < 1e-6); // behind everything
    });
    CHECK(stacked > 100);
}

TEST_CASE("without fragments the reference is percentage-closer filtering")
{
    const translucent_occluders opaque = occluders().opaque_alone();
    const texel_stacks stacks(opaque);
    const translucent_view view(scenery(), scenery().eye, 64, 36, resolution);
    int partly = 0;
    for (const map_receiver& where : view.where) {
        const double expected = percentage_closer_intensity<double>(opaque.opaque, where, taps);
        const of_colours found = stacks.filtered_intensity(where, taps);
        for (int c = 0; c < 4; ++c) CHECK(std::abs(found[c] - expected) < 1e-6);
        partly += 0.1 < expected && expected < 0.9;
    }
    CHECK(partly > 50);
}

TEST_CASE("fragments that survive by chance shadow as the stack does, on average")
{
    const texel_stacks stacks(occluders());
    constexpr int seeds = 64, samples = 4 * seeds;
    std::vector<depth_map> maps;
    for (std::uint32_t seed = 0; seed < seeds; ++seed) maps.push_back(stochastic_depths(occluders(), {.seed = seed}));
    double error = 0;
    int texels = 0;
    visit_stacks([&](int x, int y, std::span<const renderer::fragment> fragments) {
        const float z_f = fragments[fragments.size() / 2].depth;
        const double expected = stacks.intensity(x, y, z_f).x;
        int before = 0;
        for (const depth_map& one : maps)
            before += static_cast<int>(std::ranges::count_if(one(x, y), [&](float z) { return z < z_f; }));
        const double found = double(before) / samples;
        CHECK(std::abs(found - expected) < 6 * std::sqrt(expected * (1 - expected) / samples) + 1. / samples);
        error += found - expected, ++texels;
    });
    CHECK(std::abs(error / texels) < 3 * 0.5 / std::sqrt(double(samples) * texels));
}

TEST_CASE("weights of a pixel's receivers are what the eye sees of each")
{
    const translucent_view view(scenery(), scenery().eye, 64, 36, resolution);
    std::vector<double> sums(view.seen.opaque.pixels.size());
    for (const seen_receiver& r : view.receivers) {
        CHECK(r.weight >= 0);
        sums[r.pixel] += double(r.weight);
    }
    for (const double sum : sums) CHECK(sum < 1 + 1e-5);
    const renderer::image<float> dark = view.lit(numbers(view.size(), 0.f));
    for (std::size_t i = 0; i < sums.size(); ++i) CHECK(std::abs(double(dark.pixels[i]) - (1 - sums[i])) < 1e-5);
    CHECK(view.first_in_smoke > 0);
    CHECK(view.first_in_smoke < view.size());
    for (std::size_t i = 0; i < view.size(); ++i) {
        const renderer::mesh& seen = scenery().world.meshes[static_cast<std::size_t>(view.receivers[i].mesh)];
        CHECK((i >= view.first_in_smoke) == (material_of(seen) == material::smoke));
    }
}
