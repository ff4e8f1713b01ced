// Maps of line samples (Gribel et al. 2011) at some instants of the shutter interval, and receivers at these instants.
#pragma once

#include "light_receivers.hpp"
#include "range_maps.hpp"
#include "renderer/raster/moving_rasterizer.hpp"

#include <gnomon/passes/range/lines.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::evaluation {

// How a receiver reads lines: as the means of whole lines, bilinearly weighed; at its own place on them; or at its own
// place on lines along x and lines along y of each instant. Otherwise instants take turns at the two directions.
enum class line_look_up { averaged, placed, crossed };

struct line_maps {
    int resolution = 0;
    std::vector<float> times;                            // in order
    std::vector<renderer::range_lists> along_x, along_y; // of each time, without lists for a direction that is not read

    std::size_t bytes() const;
};

line_maps rasterize_lines(const renderer::moving_scene& world, const renderer::moving_camera& light, int resolution,
                          std::vector<float> times, line_look_up how);

// Those segments of one time each that face the light, ordered by their times, and their numbers.
struct line_receivers {
    std::vector<line_receiver<float>> where;
    std::vector<std::uint32_t> segments;
    std::vector<std::size_t> ends; // of the receivers of each time
};
line_receivers line_receivers_of(const renderer::seen_motion& at_times, const renderer::moving_camera& light,
                                 const line_maps& maps);

// The visibility of each segment; that of segments which face away stays as it is.
void line_visibility(const line_maps& maps, const line_receivers& receivers, line_look_up how,
                     std::span<float> of_segments);

} // namespace gnomon::evaluation
