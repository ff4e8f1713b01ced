// Percentage-closer soft shadows, for floats and doubles, over depths that have one sample or several in each texel.
#pragma once

#include "soft_method.hpp"
#include "texel_region.hpp"

#include <gnomon/comparators/percentage_closer_soft.h>
#include <gnomon/filters/percentage_closer.h>

namespace gnomon::evaluation {

// A sample of a texel, and of the texels that lanes are at; beyond the map that of its edge.
template <class Real, std::size_t samples>
Real depth_at(const renderer::image<std::array<float, samples>>& depths, int x, int y, std::size_t sample)
{
    return Real(depths(x, y)[sample]);
}
template <class Real, std::size_t samples>
Real depth_at(const renderer::image<std::array<float, samples>>& depths, const Real& x, const Real& y,
              std::size_t sample)
{
    const scattered<std::type_identity_t, Real> columns(x), rows(y);
    return gathered<std::type_identity_t, Real>([&](std::size_t i) {
        return depths(std::min(static_cast<int>(columns[i]), depths.width - 1),
                      std::min(static_cast<int>(rows[i]), depths.height - 1))[sample];
    });
}

// The whole search region, and then the whole filter region, the same rectangles as those of summed-area tables. Blockers
// are before the receiver's plane at their texel, by the rise of half a texel at least. The search ends the look-up in full
// light and in the umbra where may_skip.
template <class Real, std::size_t samples>
Real percentage_closer_soft_intensity(const renderer::image<std::array<float, samples>>& depths,
                                      const soft_light& light, const soft_place<Real>& where, bool may_skip)
{
    const Real none(0), all(1), share_of_sample = Real(1) / Real(int(samples));
    const Real margin = Real(0.5) * (gnomon_abs(where.slope_x) + gnomon_abs(where.slope_y));
    const Real right = where.x - Real(0.5), below = where.y - Real(0.5);
    auto search = percentage_closer_search_begin(where.depth - margin);
    visit_texels(summed_area_grow(light.clipped(light.search_rectangle(where))),
                 [&](const auto& x, const auto& y, const Real& share) {
                     const Real rise = where.slope_x * (Real(x) - right) + where.slope_y * (Real(y) - below);
                     for (std::size_t k = 0; k < samples; ++k)
                         search = percentage_closer_search_add(search, depth_at<Real>(depths, x, y, k) - rise,
                                                               share * share_of_sample);
                 });
    const auto blocker = percentage_closer_search_end(search);
    const auto some = none < blocker.intensity,
               in_umbra = Real(may_skip ? 1 - 1e-4f : 2) < blocker.intensity; // one texel of 4096 is more
    const auto done = in_umbra || (!some && none < Real(may_skip ? 1 : 0));
    Real result = gnomon_select(in_umbra, all, none);
    if (gnomon_any(!done)) {
        const soft_widths<Real> widths = light.penumbra(where.depth, gnomon_select(some, blocker.depth, where.depth));
        summed_area_rectangle<Real> r = light.clipped(light.filter_rectangle(where, widths));
        r.x1 = gnomon_select(done, r.x0, r.x1);
        auto filter = percentage_closer_begin(biased_depth(where, widths));
        visit_texels(r, [&](const auto& x, const auto& y, const Real& share) {
            for (std::size_t k = 0; k < samples; ++k)
                filter = percentage_closer_add(filter, depth_at<Real>(depths, x, y, k), share * share_of_sample);
        });
        result = gnomon_select(done, result, percentage_closer_end(filter));
    }
    return result;
}

} // namespace gnomon::evaluation
