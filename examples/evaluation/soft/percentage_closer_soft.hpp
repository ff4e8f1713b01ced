// Percentage-closer soft shadows, for floats and doubles, over depths that have one sample or several in each texel.
#pragma once

#include "soft_method.hpp"
#include "texel_region.hpp"

#include <gnomon/comparators/percentage_closer_soft.h>
#include <gnomon/filters/percentage_closer.h>

namespace gnomon::evaluation {

// The whole search region, and then the whole filter region, the same rectangles as those of summed-area tables. Blockers
// are before the receiver's plane at their texel, by the rise of half a texel at least. The search ends the look-up in full
// light and in the umbra where may_skip.
template <class Real, std::size_t samples>
Real percentage_closer_soft_intensity(const renderer::image<std::array<float, samples>>& depths,
                                      const soft_light& light, const soft_receiver& at, bool may_skip)
{
    const soft_place<Real> where{Real(at.x), Real(at.y), Real(at.depth), Real(at.slope_x), Real(at.slope_y)};
    const Real margin = Real(0.5) * (std::abs(where.slope_x) + std::abs(where.slope_y));
    const Real right = where.x - Real(0.5), below = where.y - Real(0.5);
    auto search = percentage_closer_search_begin(where.depth - margin);
    visit_texels(summed_area_grow(light.clipped(light.search_rectangle(where))), [&](int x, int y, Real share) {
        const Real rise = where.slope_x * (Real(x) - right) + where.slope_y * (Real(y) - below);
        for (const float z : depths(x, y))
            search = percentage_closer_search_add(search, Real(z) - rise, share / Real(samples));
    });
    const auto blocker = percentage_closer_search_end(search);
    if (may_skip && !(blocker.intensity > 0)) return 0;
    if (may_skip && blocker.intensity > Real(1 - 1e-4)) return 1; // one texel of 4096 is more
    const soft_widths<Real> widths = light.penumbra(where.depth, blocker.intensity > 0 ? blocker.depth : where.depth);
    auto filter = percentage_closer_begin(biased_depth(where, widths));
    visit_texels(light.clipped(light.filter_rectangle(where, widths)), [&](int x, int y, Real share) {
        for (const float z : depths(x, y)) filter = percentage_closer_add(filter, Real(z), share / Real(samples));
    });
    return percentage_closer_end(filter);
}

} // namespace gnomon::evaluation
