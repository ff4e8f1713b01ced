// Filter regions of few surfaces: the exact shadow intensity, and the intensity that a filterable method finds.
#pragma once

#include "evaluation/core/method.hpp"

#include <span>

namespace gnomon::evaluation {

// A surface in a filter region: its signed depth and the share of the region that it covers.
struct layer {
    float depth, weight;
};

// Sum of the weights in front of depth z_f.
double exact_intensity(std::span<const layer> region, float z_f);

// Channels of the region: each depth rendered into the format, averaged in float, stored once.
filterable_method::channels filtered(const filterable_method& m, std::span<const layer> region);

// The most that a receiver at depth z_f is too bright, at least 0.
double leak_at(const filterable_method& m, std::span<const layer> region, float z_f);

} // namespace gnomon::evaluation
