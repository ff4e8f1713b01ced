// The shadow maps of depth-time ranges that motion_analytic compares: what of the ranges of each texel they keep, how
// much memory that takes, and how long it takes to build. Ids are the triangles' numbers, counted through all meshes.
#pragma once

#include <gnomon/passes/range_map.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "toolbox/moving_scene.hpp"

namespace gnomon::demo {

struct range_shadow_map {
    std::string method, format;
    int resolution = 0;
    std::vector<std::uint32_t> first; // as in range_map
    std::vector<depth_time_range<float>> ranges;
    std::vector<range_total<float>> totals; // of each texel, or none
    std::size_t bytes = 0;                  // of all that a receiver may ask
    double build_ms = 0;                    // on one core
    std::size_t pairs = 0;                  // of a texel and a triangle that covers it at some time
    bool resolved = false;                  // lists are in order of time, and none of their ranges overlap

    std::size_t covers = 0; // texels that one triangle covers for the whole of the shutter

    // What merging has cost the texel that it has cost most, and the mean over all texels; see range_list.
    float most_time_added = 0, most_depth_added = 0, mean_time_added = 0, mean_depth_added = 0;

    double bytes_per_texel() const { return double(bytes) / (double(resolution) * double(resolution)); }
    range_map<float> map() const { return {std::size_t(resolution), std::size_t(resolution), first, ranges, totals}; }
};

// Ranges of the exact maps are split where depth is further from a line, over depths from -1 to 1.
inline constexpr float depth_tolerance = 2e-4f;

// All ranges, exact by edge functions in time. As for all others, memory has been used before when time is taken.
range_shadow_map exact_ranges(const toolbox::moving_scene& world, const toolbox::moving_camera& light, int resolution);

// What of them is in front when.
range_shadow_map resolved_ranges(const toolbox::moving_scene& world, const toolbox::moving_camera& light,
                                 int resolution);

// The same without backdrops: what shadows something.
range_shadow_map caster_ranges(const toolbox::moving_scene& world, const toolbox::moving_camera& light, int resolution);

// Resolved ranges, and for each texel what they hide together, for receivers at rest behind all of them.
range_shadow_map with_totals(range_shadow_map resolved);

// Resolved ranges packed into half the memory (packed_spans.hpp); ranges are what is unpacked.
range_shadow_map packed_ranges(const range_shadow_map& resolved);

// The temporal shadow map of Hong & Oh 2017 in one pass: where one range covers a texel, what it hides is left out.
range_shadow_map covered_ranges(const range_shadow_map& exact);

// Hong & Oh's ranges by prisms, and with coverage by their three passes; bytes by their formula (2).
range_shadow_map prism_ranges(const toolbox::moving_scene& world, const toolbox::moving_camera& light, int resolution);
range_shadow_map covered_prism_ranges(const toolbox::moving_scene& world, const toolbox::moving_camera& light,
                                      int resolution);

// Exact ranges, one after the other, into lists of a fixed capacity, 4, 8 or 16, resolved in the end. The time is the
// sum of what all threads have spent. Throws std::invalid_argument for another capacity.
range_shadow_map interval_lists(const range_shadow_map& exact, int capacity);

} // namespace gnomon::demo
