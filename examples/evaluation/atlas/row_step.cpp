// The step between the texels of a row: it is that of the ray in the middle of a range of angles. Other rays cross the texels
// in shorter or longer steps, so they are weighted wrongly.
#include "sweep.hpp"

#include <gnomon/scattering/transmittance_weights.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace gnomon::evaluation::row_step {

namespace {

constexpr double degree = 3.141592653589793 / 180;
constexpr int texels = 256;

// The share of the light that a ray of this optical depth gets from its last part, from a share `begin` of it on.
double exact(double depth, double begin) { return (std::exp(-depth * begin) - std::exp(-depth)) / -std::expm1(-depth); }

// The same from the prefix average of a row, for a ray that ends at a column.
double average(double sine, double depth, double end, double begin)
{
    const float q = transmittance_step(float(depth), 1.0f / texels, float(sine));
    const int columns = int(std::lround(end * texels)), first = int(std::lround(begin * end * texels));
    float g = 1, mean = first > 0 ? 0 : 1;
    for (int u = 1; u < columns; ++u) {
        g = transmittance_weight_next(g, q);
        mean += g * ((u < first ? 0 : 1) - mean);
    }
    return double(mean);
}

// The root mean square error over rays of equal lengths and this optical depth, in shadow up to a quarter, half or three
// quarters. Their angles to the light are within a range about the middle, and fill its solid angle.
double error(double depth, double middle, double half_range)
{
    constexpr int rays = 16;
    const double first = middle - half_range, last = std::min(middle + half_range, 90.0);
    const auto sine = [](double degrees) { return std::sin(degrees * degree); };
    double squares = 0, weights = 0;
    for (int i = 0; i < rays; ++i) {
        const double weight = sine(first + (last - first) * (i + 0.5) / rays);
        for (const double begin : {0.25, 0.5, 0.75}) {
            const double found = average(sine((first + last) / 2) / sine(last), depth, weight / sine(last), begin);
            squares += weight * (found - exact(depth, begin)) * (found - exact(depth, begin));
            weights += weight;
        }
    }
    return std::sqrt(squares / weights);
}

std::vector<sweep_layer> layers()
{
    std::vector<sweep_layer> result;
    for (const int middle : {75, 60, 45, 30})
        result.push_back({"step_" + std::to_string(middle), "about " + std::to_string(middle) + " degrees to the light",
                          [=](double depth, double half_range) { return error(depth, middle, half_range); }});
    return result;
}

const registered<sweep> entry{
    sweep{.id = "row_step",
          .label = "Step of a row",
          .order = 190,
          .text = "Rays of equal lengths, at angles to the light within a range, are in shadow at first. The texels of "
                  "their row have the weights of the angle in the middle of the range. The errors are those of the "
                  "weights alone: the distribution of depths is exact.",
          .x = {"depth", "optical depth of a ray", scale::log, 0.01, 100, 25},
          .y = {"range", "half of the range of angles in degrees", scale::linear, 0, 30, 16},
          .error_label = "root mean square error",
          .threshold = 0.05,
          .layers = layers}};

} // namespace

} // namespace gnomon::evaluation::row_step
