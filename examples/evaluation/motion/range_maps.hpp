// The shadow maps of depth-time ranges that motion_analytic compares: what of the ranges of each texel they keep, how
// much memory that takes, and how long it takes to build. Ids are the triangles' numbers, counted through all meshes,
// or those of surfaces.
#pragma once

#include "renderer/scene/moving_scene.hpp"

#include <gnomon/motion/receiver/static_receiver.h>
#include <gnomon/passes/range/compact.hpp>
#include <gnomon/passes/range/map.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace gnomon::evaluation {

// The facts that all of these maps tell of themselves. Time is that of one core for all that a receiver may ask:
// building and resolving, and totals and packing where there are any.
struct map_facts {
    std::string method, format;
    int resolution = 0;
    std::size_t bytes = 0; // of all that a receiver may ask
    double build_ms = 0;
    std::size_t pairs = 0;          // of a texel and a triangle that covers it at some time
    std::size_t covers = 0;         // texels that one triangle covers for the whole of the shutter
    std::size_t building_bytes = 0; // of what is needed to build it, where the method's authors count that, too

    double bytes_per_texel() const { return double(bytes) / (double(resolution) * double(resolution)); }
};

struct range_shadow_map : map_facts {
    std::vector<std::uint32_t> first{}; // as in range_map
    std::vector<depth_time_range<float>> ranges{};
    std::vector<range_summary<float>> totals{};          // of each texel, or none
    std::vector<depth_time_range<float>> texel_covers{}; // of each texel, empty where a list is asked; or none
    bool resolved = false;                               // lists are in order of time, and none of their ranges overlap

    // What merging has cost the texel that it has cost most, and the mean over all texels; see range_list.
    float most_time_added = 0, most_depth_added = 0, mean_time_added = 0, mean_depth_added = 0;

    range_map<float> map() const { return {std::size_t(resolution), std::size_t(resolution), first, ranges, totals}; }
};

// Ranges of the exact maps are split where depth is further from a line, over depths from -1 to 1.
inline constexpr float depth_tolerance = 2e-4f;

// All ranges, exact by edge functions in time. As for all others, memory has been used before when time is taken.
range_shadow_map exact_ranges(const renderer::moving_scene& world, const renderer::moving_camera& light,
                              int resolution);

// What of them is in front when.
range_shadow_map resolved_ranges(const renderer::moving_scene& world, const renderer::moving_camera& light,
                                 int resolution);

// The same with those of one mesh joined that follow one another on nearly one line.
range_shadow_map joined_ranges(const renderer::moving_scene& world, const renderer::moving_camera& light,
                               int resolution);

// Resolved ranges without backdrops: what shadows something.
range_shadow_map caster_ranges(const renderer::moving_scene& world, const renderer::moving_camera& light,
                               int resolution);

// Resolved ranges, and for each texel what they hide together, for receivers at rest behind all of them.
range_shadow_map with_totals(range_shadow_map resolved);

// The same with other ids: those of the surfaces that triangles are part of.
range_shadow_map with_ids(range_shadow_map by_triangles, std::span<const std::uint32_t> id_of_triangle);

// The temporal shadow map of Hong & Oh 2017 in one pass: where one range covers a texel, what it hides is left out.
range_shadow_map covered_ranges(const range_shadow_map& exact);

// The same for receivers that ask the cover first: where that is one range, it stands for the list.
range_shadow_map cover_first_ranges(const range_shadow_map& exact);

// Hong & Oh's ranges by prisms, and with coverage by their three passes. Their formula (2) counts the fragments that
// are needed to build them, too.
range_shadow_map prism_ranges(const renderer::moving_scene& world, const renderer::moving_camera& light,
                              int resolution);
range_shadow_map covered_prism_ranges(const renderer::moving_scene& world, const renderer::moving_camera& light,
                                      int resolution);

// Exact ranges, one after the other, into lists of a fixed capacity, 4, 8 or 16, resolved in the end. The time is the
// sum of what all threads have spent. Throws std::invalid_argument for another capacity.
range_shadow_map interval_lists(const range_shadow_map& exact, int capacity);

// Resolved ranges and their summaries in half the memory, which look-ups read directly.
struct compact_shadow_map : map_facts {
    std::vector<std::uint16_t> begins{}, lists{}; // as in compact_spans
    std::vector<std::uint64_t> bodies{};
    std::vector<std::uint32_t> groups{};
    std::vector<range_summary<float>> totals{}; // of each texel, or none

    compact_range_map map() const
    {
        return {std::size_t(resolution), std::size_t(resolution), {begins, bodies, groups, lists}, totals};
    }
};
compact_shadow_map compact_ranges(const range_shadow_map& resolved);

std::size_t texels_of(int resolution);

// Of lists and the numbers where they begin.
std::size_t list_bytes(const range_shadow_map& m);

std::span<const depth_time_range<float>> list_of(const range_shadow_map& m, std::size_t texel);

} // namespace gnomon::evaluation
