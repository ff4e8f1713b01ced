// Level sheets of stripes that move in a small light map while the shutter is open: what stochastic shadow maps find for
// receivers behind them, and the exact visibility.
#pragma once

#include "sweep.hpp"

#include <gnomon/passes/layers/layer_map.hpp>
#include <gnomon/passes/sample_map.hpp>

#include <functional>
#include <string>
#include <vector>

namespace gnomon::evaluation {

// Stripes across a direction, in texels. In the middle of the map a sheet moves by `speed` texels in its direction while
// the shutter is open; if it turns, by an angle in radians, it does so about a point `distance` texels to the side instead.
struct moving_sheet {
    double direction = 0, depth = 0, speed = 0, turn = 0, distance = 0, stripe = 12, period = 30;
};

// A receiver at place (x, y) at time t, which moves by (motion_x, motion_y) texels while the shutter is open.
struct sheet_receiver {
    double x, y, t, motion_x, motion_y;
};
using sheet_visibility = std::function<double(const sheet_receiver&)>;

// A way to look up shadows in samples.
struct sheet_method {
    std::string id, label;
    std::function<sheet_visibility(const sample_map<float>& samples)> map_of;
};

// Layers of two moments by these settings, and time-dependent maps with 2 x 2 filtering.
sheet_method layers_with(std::string id, std::string label, const layer_settings& how);
sheet_method time_dependent_sheets();

// Layers by the settings of the paper for quality and for speed, and time-dependent maps.
std::vector<sheet_method> sheet_methods();

// The root mean square error over pixels behind all sheets, as large as a texel, of 4 samples at stratified times each.
// Half of the pixels are static in the map, half follow the first sheet. The map has some samples for each texel.
double error_behind(const std::vector<moving_sheet>& sheets, int samples, const sheet_method& by);

} // namespace gnomon::evaluation
