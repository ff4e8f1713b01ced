// Shadow maps of depth-time ranges: lists of what the light sees in each texel, from one time to another and from one
// depth to another. Ids are the triangles' numbers, counted through all meshes, or those of surfaces.
#pragma once

#include "evaluation/core/method.hpp"

#include <gnomon/motion/range/range_summary.h>
#include <gnomon/passes/range/map.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace gnomon::evaluation {

inline const registered<map_kind> range_lists_kind{
    map_kind{.id = "range_lists", .label = "lists of ranges", .order = 110}};
inline const registered<map_kind> resolved_lists_kind{
    map_kind{.id = "resolved_lists", .label = "lists of ranges in order of time, without overlap", .order = 120}};

// Facts of any map in motion. Time is that of one core for all that look-ups read: building and resolving, and totals
// and packing where there are any.
struct map_facts {
    std::string label;    // of the method, for people
    std::string kind;     // id of a map_kind
    storage_facts format; // id and label
    int resolution = 0;
    evaluation::parameters parameters{};
    std::size_t bytes = 0; // of all that look-ups read
    double build_ms = 0;
    std::size_t pairs = 0;          // of a texel and a triangle that covers it at some time
    std::size_t covers = 0;         // texels that one triangle covers while the shutter is open
    std::size_t building_bytes = 0; // needed while the map is built, where the method's authors state them; else 0

    double bytes_per_texel() const { return double(bytes) / (double(resolution) * double(resolution)); }
};

struct range_shadow_map : map_facts {
    std::vector<std::uint32_t> first{}; // as in range_map
    std::vector<depth_time_range<float>> ranges{};
    std::vector<range_summary<float>> totals{};          // of each texel, or none
    std::vector<depth_time_range<float>> texel_covers{}; // of each texel, empty where the list is read; or none
    bool resolved = false;                               // lists are in order of time, and none of their ranges overlap

    // Time and depth that merging has added in the worst texel, and their means over all texels; see range_list.
    float most_time_added = 0, most_depth_added = 0, mean_time_added = 0, mean_depth_added = 0;

    range_map<float> map() const { return {std::size_t(resolution), std::size_t(resolution), first, ranges, totals}; }
};

// Ranges of exact maps are split where depth departs by more from a line, over depths from -1 to 1.
inline constexpr float depth_tolerance = 2e-4f;

// An empty map of unresolved lists.
range_shadow_map unresolved_lists(std::string label, int resolution);

// The resolved map with the totals of each texel: what its ranges hide together, for static receivers behind all of
// them. The parameter "totals" is 1.
range_shadow_map with_totals(range_shadow_map resolved);

// The map with other ids: those of the surfaces that triangles are part of. The parameter "surfaces" is 1.
range_shadow_map with_ids(range_shadow_map by_triangles, std::span<const std::uint32_t> id_of_triangle);

std::size_t texels_of(int resolution);

// Bytes of the lists and of the numbers where they begin.
std::size_t list_bytes(const range_shadow_map& m);

std::span<const depth_time_range<float>> list_of(const range_shadow_map& m, std::size_t texel);

} // namespace gnomon::evaluation
