// Filter passes in the storage format: each pass rounds, and the roundings add up.
#include "region.hpp"
#include "sweep.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace gnomon::evaluation::filter_passes {

namespace {

constexpr std::size_t texels = 32, stripe = 8;

// A row of stripes of two depths under passes of a filter of three taps, beyond whose ends the row repeats: the most
// that a receiver on either depth, above any texel, is too dark.
double error(const filterable_method& m, double passes, double distance)
{
    const float near_depth = float(-distance / 2), far_depth = float(distance / 2);
    std::array<double, texels> near_share{};
    std::vector<filterable_method::channels> row(texels);
    for (std::size_t i = 0; i < texels; ++i) {
        near_share[i] = i / stripe % 2 == 0 ? 1 : 0;
        row[i] = m.from_depth(near_share[i] > 0 ? near_depth : far_depth);
    }
    for (int pass = 0; pass < int(passes); ++pass) {
        const std::array<double, texels> share = near_share;
        const std::vector<filterable_method::channels> source = row;
        for (std::size_t i = 0; i < texels; ++i) {
            const std::size_t before = (i + texels - 1) % texels, after = (i + 1) % texels;
            near_share[i] = 0.25 * share[before] + 0.5 * share[i] + 0.25 * share[after];
            for (std::size_t k = 0; k < row[i].size(); ++k)
                row[i][k] = 0.25f * source[before][k] + 0.5f * source[i][k] + 0.25f * source[after][k];
            row[i] = m.store(row[i]);
        }
    }
    double worst = 0;
    for (std::size_t i = 0; i < texels; ++i)
        worst = std::max(
            {worst, double(m.intensity(row[i], near_depth)), double(m.intensity(row[i], far_depth)) - near_share[i]});
    return worst;
}

const registered<sweep> entry{sweep{
    .id = "filter_passes",
    .label = "Filter passes in the storage format",
    .order = 60,
    .text =
        "Stripes of two depths are filtered again and again by three taps, and every pass stores its result in the "
        "format. "
        "The error is the most by which a receiver on either surface becomes too dark. The formats' biases are made "
        "for two passes.",
    .x = {"passes", "filter passes", scale::log, 1, 64, 13},
    .y = {"distance", "distance of the surfaces", scale::log, 1e-4, 1.5, 16},
    .error_label = "darkening",
    .threshold = 0.02,
    .layers = [] { return layers_of_methods(error); }}};

} // namespace

} // namespace gnomon::evaluation::filter_passes
