// The number of surfaces over a view ray: a row knows as many as its moments tell apart.
#include "view_ray.hpp"

#include <cmath>
#include <vector>

namespace gnomon::evaluation::row_surfaces {

namespace {

// Root mean square error over rays before, midway between and behind surfaces that are spread evenly over a part of the
// depth.
double error(const row_intensity& intensity, double count, double spread)
{
    const int n = int(std::lround(count));
    const auto depth = [&](double i) { return float(spread * ((2 * i + 1) / n - 1)); };
    std::vector<layer> row;
    for (int i = 0; i < n; ++i) row.push_back({depth(i), 1 / float(n)});
    double squares = 0;
    for (int i = 0; i <= n; ++i) {
        const double difference = error_of_row(intensity, row, depth(i - 0.5), 0.5f);
        squares += difference * difference;
    }
    return std::sqrt(squares / (n + 1));
}

const registered<sweep> entry{sweep{
    .id = "row_surfaces",
    .label = "Surfaces over a view ray",
    .order = 150,
    .text = "Surfaces at evenly spread depths shadow equal parts of a row. Rays are before the first, midway between "
            "two and behind the last, and take the middle of the bounds.",
    .x = {"count", "number of surfaces", scale::linear, 1, 24, 24},
    .y = {"spread", "half of the range of depth that they use", scale::log, 0.002, 0.9, 16},
    .error_label = "root mean square error",
    .threshold = 0.1,
    .layers = [] { return layers_of_rows(error); }}};

} // namespace

} // namespace gnomon::evaluation::row_surfaces
