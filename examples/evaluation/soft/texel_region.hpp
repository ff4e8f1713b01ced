// Texels under a rectangle, with the area that the rectangle has in each, as a share of its whole area: what percentage-
// closer soft shadows go through.
#pragma once

#include <gnomon/soft/summed_area.h>

#include <algorithm>
#include <cmath>

namespace gnomon::evaluation {

// Calls visit(x, y, share) for each texel under a rectangle that lies in the map; shares sum to 1.
template <class Real> void visit_texels(const summed_area_rectangle<Real>& r, auto&& visit)
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

} // namespace gnomon::evaluation
