// What methods make of contacts, where a filter region holds two close surfaces and the receiver is the farther one, as
// the demo's maps and look-ups have it. The truth is percentage-closer filtering with the same weights.
#include "evaluation/core/receivers.hpp"
#include "evaluation/core/report.hpp"
#include "evaluation/methods/methods.hpp"
#include "renderer/scene/stage.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cstddef>
#include <vector>

using namespace gnomon;
using namespace gnomon::evaluation;

namespace {

const auto taps = gaussian_weights();

struct contact {
    depth_map depths;
    receivers where;
    std::vector<float> truth, truth_unbiased; // visibility

    contact()
    {
        constexpr int width = 320, height = 180, resolution = 1024;
        const renderer::stage scenery = renderer::contact_stage(double(width) / height);
        depths = renderer::rasterize_depth<4>(scenery.world, scenery.light, resolution, resolution);
        const auto seen = renderer::rasterize_surfaces(scenery.world, scenery.eye, width, height);
        where = receivers_of(seen, scenery.light, resolution);
        const auto intensity = [this](std::size_t i, float z_f) {
            return percentage_closer_intensity<double>(depths, where.places[i], z_f, taps);
        };
        truth = visibility(where.depths, intensity);
        truth_unbiased = visibility(where.unbiased_depths, intensity);
    }

    static std::vector<float> visibility(const std::vector<float>& receiver_depths, auto&& intensity)
    {
        std::vector<float> result;
        for (std::size_t i = 0; i < receiver_depths.size(); ++i)
            result.push_back(static_cast<float>(1 - intensity(i, receiver_depths[i])));
        return result;
    }

    // With depth bias, and without.
    template <method M> std::array<renderer::error_statistics, 2> errors() const
    {
        const typename M::map map(depths, taps);
        const auto intensity = [&](std::size_t i, float z_f) {
            return M::intensity(M::fetch(map, where.places[i]), z_f);
        };
        return {renderer::compare(visibility(where.depths, intensity), truth),
                renderer::compare(visibility(where.unbiased_depths, intensity), truth_unbiased)};
    }
};

const contact& contacts()
{
    static const contact result;
    return result;
}

} // namespace

TEST_CASE("raised pivots darken lit receivers")
{
    const auto [biased, unbiased] = contacts().errors<msm_64_raised>();
    CHECK(biased.max_dark > 0.05);
    CHECK(biased.darkened > 1e-3);
    CHECK(unbiased.max_dark > 0.05);
}

TEST_CASE_TEMPLATE("no format darkens a receiver by more than its weight", M, msm_64, msm_64_half, msm_128, msm6_60,
                   msm6_96, msm6_192)
{
    for (const renderer::error_statistics& e : contacts().errors<M>()) {
        CHECK(e.max_dark <= M::storage::filtered_darkening + 0x1p-24); // two visibilities are rounded to float
        CHECK(e.darkened == 0);
    }
}
