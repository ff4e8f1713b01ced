// Sweeps: two named parameters on a grid, the error of each method there, and the error from which on a method fails. The
// gallery draws the failing region, and tests/evaluation/sweeps holds its edge.
#pragma once

#include "evaluation/core/blocks.hpp"
#include "evaluation/core/method.hpp"
#include "evaluation/core/registry.hpp"

#include <functional>
#include <string>
#include <vector>

namespace gnomon::evaluation {

// A parameter's values from least to most: evenly spaced, or with an even ratio on a logarithmic scale.
struct sweep_axis {
    std::string id, label;
    evaluation::scale scale = evaluation::scale::linear;
    double least = 0, most = 1;
    int count = 2;

    std::vector<double> values() const;
};

// The error of one method, or of one format where the sweep is of a setting, at a point of the grid.
struct sweep_layer {
    std::string id, label;
    std::function<double(double x, double y)> error;
};

struct sweep {
    using kind = sweep;
    static constexpr const char* kind_name = "sweep";

    std::string id, label;
    double order = 0;
    std::string text; // what is evaluated, for the gallery
    sweep_axis x, y;
    std::string error_label;
    double threshold = 0; // a greater error is a failure
    std::vector<sweep_layer> (*layers)() = nullptr;
};

// A layer for each filterable method of the registry.
std::vector<sweep_layer> layers_of_methods(
    const std::function<double(const filterable_method&, double x, double y)>& error);

// The errors of a layer, a row for each value of y.
std::vector<std::vector<double>> errors_of(const sweep& s, const sweep_layer& l);

} // namespace gnomon::evaluation
