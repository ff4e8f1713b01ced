#include "tile_bins.hpp"

#include <algorithm>

namespace gnomon::renderer {

void tile_bins::assign(const tiled_triangles& scenery, std::size_t tile, bool front_to_back)
{
    triangles_.clear();
    touching_.clear();
    times_.clear();
    members_.clear();
    const moving_tile where = scenery.tile(tile);
    scenery.for_each(tile, [&](const moving_setup& s) { members_.push_back(&s); });
    if (front_to_back) std::ranges::stable_sort(members_, {}, &moving_setup::nearest);
    for (const moving_setup* member : members_) {
        const moving_setup& s = *member;
        const std::size_t i = triangles_.size() % 64;
        if (timed_) times_.emplace_back().end.fill(1);
        if (i == 0) touching_.emplace_back();
        const std::uint64_t blocks =
            triangles_.emplace_back(s, where).blocks(scenery.reach(), timed_ ? &times_.back() : nullptr);
        for_each_bit(blocks, [&](std::size_t block) { touching_.back()[block] |= std::uint64_t(1) << i; });
    }
}

} // namespace gnomon::renderer
