#include "covers.hpp"

#include <algorithm>

namespace gnomon::evaluation {

namespace {

using range = depth_time_range<float>;

uncut_range uncut(std::span<const range> list)
{
    uncut_range result{1, list[0]};
    range& whole = result.whole;
    for (; result.pieces < list.size(); ++result.pieces) {
        const range& next = list[result.pieces];
        if (next.id != whole.id || next.t0 != whole.t1) break;
        const float nearest = std::min({whole.z0, whole.z1, next.z0, next.z1}),
                    farthest = std::max({whole.z0, whole.z1, next.z0, next.z1});
        whole = {whole.t0, next.t1, nearest, farthest, whole.id};
    }
    return result;
}

} // namespace

uncut_range cover_of(std::span<const range> list)
{
    range_cover<float> state = range_cover_begin(1.f);
    uncut_range best{0, range_empty(-1.f)};
    for (std::size_t i = 0; i < list.size();) {
        const uncut_range some = uncut(list.subspan(i));
        state = range_cover_add(state, some.whole);
        if (state.best.id == some.whole.id && state.best.z0 == some.whole.z0 && state.best.z1 == some.whole.z1)
            best = some;
        i += some.pieces;
    }
    best.whole = range_cover_end(state);
    return best;
}

void add_visible(const range& cover, std::span<const range> list, std::vector<range>& to)
{
    for (const range& r : list)
        if (range_cover_occludes(cover, r) == 0) to.push_back(r);
}

} // namespace gnomon::evaluation
