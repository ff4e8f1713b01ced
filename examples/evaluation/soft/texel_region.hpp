// Texels under a rectangle, with the area that the rectangle has in each, as a share of its whole area: what percentage-
// closer soft shadows go through.
#pragma once

#include "lanes.hpp"

#include <gnomon/soft/summed_area.h>

#include <algorithm>
#include <cmath>
#include <concepts>

namespace gnomon::evaluation {

// Calls visit(x, y, share) for each texel under a rectangle that lies in the map; shares sum to 1.
template <std::floating_point Real> void visit_texels(const summed_area_rectangle<Real>& r, auto&& visit)
{
    const Real area = (r.x1 - r.x0) * (r.y1 - r.y0);
    if (!(area > 0)) return;
    const auto within = [](int texel, Real begin, Real end) {
        return std::min(end, Real(texel + 1)) - std::max(begin, Real(texel));
    };
    const int x1 = static_cast<int>(std::ceil(r.x1)), y1 = static_cast<int>(std::ceil(r.y1));
    for (int y = static_cast<int>(r.y0); y < y1; ++y) {
        const Real row = within(y, r.y0, r.y1) / area;
        for (int x = static_cast<int>(r.x0); x < x1; ++x) visit(x, y, row * within(x, r.x0, r.x1));
    }
}

// The same of a rectangle for each lane, as long as a lane has texels. Lanes that have no more have shares of 0.
inline void visit_texels(const summed_area_rectangle<receiver_pack>& r, auto&& visit)
{
    using pack = receiver_pack;
    const pack area = (r.x1 - r.x0) * (r.y1 - r.y0), none(0);
    const auto within = [&](const pack& texel, const pack& begin, const pack& end) {
        return gnomon_max(gnomon_min(end, texel + pack(1)) - gnomon_max(begin, texel), none);
    };
    const summed_area_rectangle<pack> whole = summed_area_grow(r);
    const scattered<summed_area_rectangle, pack> lanes(whole);
    float columns = 0, rows = 0;
    for (std::size_t i = 0; i < pack::size; ++i) {
        columns = std::max(columns, lanes[i].x1 - lanes[i].x0);
        rows = std::max(rows, lanes[i].y1 - lanes[i].y0);
    }
    for (float j = 0; j < rows; ++j) {
        const pack y = whole.y0 + pack(j);
        const pack row = gnomon_select(none < area, within(y, r.y0, r.y1) / area, none);
        for (float i = 0; i < columns; ++i) {
            const pack x = whole.x0 + pack(i);
            visit(x, y, row * within(x, r.x0, r.x1));
        }
    }
}

} // namespace gnomon::evaluation
