// Errors of methods at contacts, where a filter region holds two close surfaces and the receiver is the farther one, as
// the demo's maps and look-ups have it. The truth is percentage-closer filtering with the same weights.
#include "evaluation/core/percentage_closer.hpp"
#include "evaluation/core/receivers.hpp"
#include "evaluation/core/report.hpp"
#include "renderer/scene/stage.hpp"

#include <gnomon/passes/blur.hpp>
#include <gnomon/storage/formats.hpp>

#include <doctest/doctest.h>

#include <array>
#include <memory>
#include <vector>

using namespace gnomon;
using namespace gnomon::evaluation;

namespace {

const auto taps = gaussian_weights();

struct contact {
    depth_map depths;
    map_receivers where;
    std::vector<float> truth, truth_unbiased; // visibility

    contact()
    {
        constexpr int width = 320, height = 180, resolution = 1024;
        const renderer::stage scenery = renderer::contact_stage(double(width) / height);
        depths = renderer::rasterize_depth<4>(scenery.world, scenery.light, resolution, resolution);
        const auto seen = renderer::rasterize_surfaces(scenery.world, scenery.eye, width, height);
        where = map_receivers_of(seen, scenery.light, resolution);
        for (const map_receiver& r : where.biased) truth.push_back(true_visibility(r));
        for (const map_receiver& r : where.unbiased) truth_unbiased.push_back(true_visibility(r));
    }

    float true_visibility(const map_receiver& r) const
    {
        return static_cast<float>(1 - percentage_closer_intensity<double>(depths, r, taps));
    }

    // With depth bias, and without.
    std::array<error_statistics, 2> errors(const shadow_method& m) const
    {
        const std::unique_ptr<shadow_map> map = m.build(depths, taps);
        const auto compared = [&](const std::vector<map_receiver>& some, const std::vector<float>& expected) {
            std::vector<float> found(some.size());
            map->intensities(some, found);
            for (float& x : found) x = 1 - x;
            return compare(found, expected);
        };
        return {compared(where.biased, truth), compared(where.unbiased, truth_unbiased)};
    }
};

const shadow_method& method_of(const char* id)
{
    return dynamic_cast<const shadow_method&>(registry_of<method>().at(id));
}

const contact& contacts()
{
    static const contact result;
    return result;
}

template <class Format> constexpr const char* ids = nullptr;
template <> constexpr const char* ids<moments4_unorm16> = "msm4_unorm16";
template <> constexpr const char* ids<moments4_half> = "msm4_half";
template <> constexpr const char* ids<moments4_float> = "msm4_float";
template <> constexpr const char* ids<moments6_unorm10> = "msm6_unorm10";
template <> constexpr const char* ids<moments6_unorm16> = "msm6_unorm16";
template <> constexpr const char* ids<moments6_float> = "msm6_float";

} // namespace

TEST_CASE("raised pivots darken lit receivers")
{
    const auto [biased, unbiased] = contacts().errors(method_of("msm4_unorm16_raised"));
    CHECK(biased.max_dark > 0.05);
    CHECK(biased.darkened > 1e-3);
    CHECK(unbiased.max_dark > 0.05);
}

TEST_CASE_TEMPLATE("no format darkens a receiver by more than its weight", Format, moments4_unorm16, moments4_half,
                   moments4_float, moments6_unorm10, moments6_unorm16, moments6_float)
{
    const char* id = ids<Format>;
    CAPTURE(id);
    for (const error_statistics& e : contacts().errors(method_of(id))) {
        CHECK(e.max_dark <= Format::filtered_darkening + 0x1p-24); // two visibilities are rounded to float
        CHECK(e.darkened == 0);
    }
}
