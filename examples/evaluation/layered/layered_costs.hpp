// Costs of layers where nothing moves, against a plain map; and costs of layers, slices and ranges by the number of cubes that
// move and by their speed.
#pragma once

#include "evaluation/core/blocks.hpp"
#include "layered_comparison.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace gnomon::evaluation {

// Layers of a scene in which nothing moves, with at most one layer in a tile, over a plain map of the same sums.
struct static_costs {
    double bytes_ratio = 0, look_up_ratio = 0;
    double plain_tiles = 0; // share of tiles that stay in a plain map
};
static_costs static_costs_of(const motion_scene& scene, const layered_sizes& size);

struct moving_cubes {
    int count;
    double speed;
};
struct rival_costs {
    const layered_method* method;
    double build_ms, look_up_ms, bytes;
};
struct moving_costs {
    moving_cubes of;
    std::vector<rival_costs> rivals;
};
inline constexpr std::array cubes_to_cost{moving_cubes{100, 1}, moving_cubes{400, 1}, moving_cubes{1600, 1},
                                          moving_cubes{400, 0.25}, moving_cubes{400, 4}};
moving_costs moving_costs_of(const moving_cubes& cubes, const layered_sizes& size);

chart_block chart_of(const std::vector<moving_costs>& found);

} // namespace gnomon::evaluation
