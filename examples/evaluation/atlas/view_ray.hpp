// View rays through air that scatters: a row of a prefix map keeps the depths of its texels, each by its share of the light
// that the air scatters to the eye, and is read at the depth of the ray. The intensity is the share of this light that
// shadows take.
#pragma once

#include "region.hpp"
#include "sweep.hpp"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::evaluation {

// The shadow intensity at depth z_f of a row. Texels are rounded to the format, averaged by their weights, and rounded
// again. An overestimation of 0 is the upper bound of the shadow, 1 the lower one; a series has no bounds.
using row_intensity = std::function<double(std::span<const layer> row, float z_f, float overestimation)>;

struct row_format {
    std::string id, label; // id ends in _row
    row_intensity intensity;
};

// Formats of a prefix map.
std::vector<row_format> row_formats();

// A layer for each of them.
std::vector<sweep_layer> layers_of_rows(const std::function<double(const row_intensity&, double x, double y)>& error);

// How far the intensity of a row is off.
double error_of_row(const row_intensity& intensity, std::span<const layer> row, float z_f, float overestimation);

} // namespace gnomon::evaluation
