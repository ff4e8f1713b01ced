// Blocks of the page about stochastic shadows in motion: pictures and numbers of scenes, noise, and rivals of equal time
// and memory.
#pragma once

#include "evaluation/core/blocks.hpp"
#include "layered_comparison.hpp"
#include "layered_costs.hpp"

#include <span>
#include <string>
#include <vector>

namespace gnomon::evaluation {

using compared_scenes = std::span<const compared_layers>;

// The methods, and how they are measured.
std::string introduction_of(const layered_sizes& size);

// The method of a family in a scene that has the least RMSE among those of a comparison, at its best constant bias; of
// those that `may` admits. A null pointer where there is none.
const layered_result* best_of(const compared_layers& scene, const family& of, std::string_view comparison, auto&& may)
{
    const layered_result* best = nullptr;
    for (const layered_result& r : scene.results)
        if (r.method->family == of.id && r.is_of(comparison) && may(r) &&
            (!best || r.row.errors.rmse < best->row.errors.rmse))
            best = &r;
    return best;
}
const layered_result* best_of(const compared_layers& scene, const family& of, std::string_view comparison);

// Pictures, pictures of errors and all numbers of a scene.
void add_scene_blocks(const compared_layers& scene, std::vector<block>& to);

// Goals of the paper and of this project, and what was found.
table_block goals_of(compared_scenes scenes, const static_costs& still);

// Standard deviations over seeds, with the camera's noise and without, and bias apart.
table_block noise_of(compared_scenes scenes);

// Rivals with about the time or the memory of the usual layers.
table_block equal_time_of(compared_scenes scenes);
table_block equal_memory_of(compared_scenes scenes);

// Models of depth within a layer: leak, acne and RMSE.
table_block models_of(compared_scenes scenes);

// Settings of layers, with pictures.
void add_settings_blocks(compared_scenes scenes, std::vector<block>& to);

// Acne against leak by the constant bias; the time of each step; layers against ranges.
chart_block bias_chart(compared_scenes scenes);
chart_block steps_chart(compared_scenes scenes);
chart_block rivals_chart(compared_scenes scenes);

} // namespace gnomon::evaluation
