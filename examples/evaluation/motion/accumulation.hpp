// Motion blur without ranges: a shadow map and a picture for each of some times, and their mean (Haeberli & Akeley 1990).
// Look-ups are by percentage-closer filtering with bilinear weights, a pack at a time.
#pragma once

#include "light_receivers.hpp"
#include "range_maps.hpp"
#include "renderer/output/image.hpp"
#include "renderer/shade/moving_view.hpp"

#include <gnomon/simd/xsimd.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::evaluation {

using accumulation_pack = gnomon::pack<xsimd::batch<float>>;

struct accumulated_maps {
    int resolution = 0;
    std::vector<float> times; // in order
    std::vector<renderer::image<std::array<float, 1>>> depths;
};

// The middles of as many equal parts of the shutter interval.
std::vector<float> middle_times(int count);

accumulated_maps accumulate(const renderer::moving_scene& world, const renderer::moving_camera& light, int resolution,
                            std::vector<float> times);

// Of maps of depth, one after the other.
map_facts accumulation_facts(int count, int resolution);

// Segments of one time each that the pixels see at these times, in order.
renderer::seen_motion seen_at_times(const renderer::seen_motion& seen, std::span<const float> times);

// Those of these segments that face the light, as the map of their time sees them, and their numbers.
struct accumulated_receivers {
    std::vector<float> x, y, depth; // texel position and biased depth; whole packs of them
    std::vector<std::uint32_t> segment;
};

// The receivers of each map.
std::vector<accumulated_receivers> accumulated_receivers_of(const renderer::seen_motion& at_times,
                                                            const renderer::moving_camera& light,
                                                            const accumulated_maps& maps);

// The visibility of each, in their order, one map after the other, by 1 or 3 x 3 bilinear look-ups.
void accumulated_visibility(const accumulated_maps& maps, std::span<const accumulated_receivers> receivers,
                            std::vector<float>& visibility, int look_ups = 1);

// The visibility of each segment; 0 for those that face away.
std::vector<float> in_order_of_segments(std::span<const accumulated_receivers> receivers,
                                        std::span<const float> visibility, std::size_t segments);

// Maps of a static light for static receivers, which read all of them at one place: the depths of a texel are side by
// side.
struct interleaved_maps {
    int resolution = 0, count = 0;
    std::vector<float> depths; // texel by texel, in the order of range_map, whole packs of them

    std::size_t depths_per_texel() const;
};

interleaved_maps interleave(const accumulated_maps& maps);

// A static receiver that faces the light.
struct static_place {
    float x, y, depth; // texel position and biased depth
};

// The mean of each receiver's visibility over all maps, by bilinear weights.
void static_visibility(const interleaved_maps& maps, std::span<const static_place> receivers,
                       std::span<float> visibility);

} // namespace gnomon::evaluation
