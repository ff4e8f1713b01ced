// A row in fog that thins out with height: it has the weights of the ray in the middle of a range of angles. Where the light
// is high, rays at other angles cross the same texels at other heights, and in another density.
#include "sweep.hpp"

#include <gnomon/passes/rectified_look_up.hpp>
#include <gnomon/passes/transmittance_prefix.hpp>
#include <gnomon/storage/moments4.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace gnomon::evaluation::fog_row {

namespace {

constexpr double pi = 3.141592653589793, degree = pi / 180;
constexpr std::size_t columns = 256;
using format = moments4_float;

// The share of its light that a ray of length 1 gets from a distance on; decay is that of density for a unit of length. At the
// eye the fog has the optical depth 1 for a unit of length.
double exact(double from, double decay)
{
    const auto amount = [&](double s) { return std::abs(decay * s) > 1e-9 ? -std::expm1(-decay * s) / decay : s; };
    const double all = amount(1), first = amount(from);
    return std::exp(-first) * std::expm1(-(all - first)) / std::expm1(-all);
}

// The largest error of rays at the ends of a range about the horizontal ray across the light, in shadow up to a quarter,
// half or three quarters. The first moment of depths -1 and 1 is that of the shares in shadow and in light.
double error(double elevation, double falloff, double half_range)
{
    const double sine = std::sin(elevation * degree), cosine = std::cos(elevation * degree);
    const double least = pi / 2 - half_range * degree, most = pi / 2 + half_range * degree;
    const rectified_fog fog{float(falloff), 0, float(cosine), float(-sine)};
    const rectified_frustum<float> bounds{1, -0.005f, 0.01f, float(least), float(most)};
    const rectified_frame frame = rectified_frame_of(bounds);
    double worst = 0;
    for (const double polar : {least, most})
        for (const double share : {0.25, 0.5, 0.75}) {
            std::array<rectified_row, 1> rows;
            rectified_rows(frame, bounds, 1, columns, rows, fog);
            const double end = std::sin(polar);
            const auto lit_from = std::size_t(std::lround(share * end * columns));
            std::vector<format::texel> texels(columns);
            for (std::size_t u = 0; u < columns; ++u)
                texels[u] = format::encode(format::from_depth(u < lit_from ? -1.0f : 1.0f));
            const map_view<format::texel> map{texels, columns, 1};
            transmittance_prefix<format>(map, rows, {0, 1});
            const auto c = rectified_channels<format>(map, frame, rows, {float(end), 0, float(polar)});
            const double expected = exact(double(lit_from) / (columns * end), -falloff * std::cos(polar) * sine);
            worst = std::max(worst, std::abs((double(c.c1) + 1) / 2 - expected));
        }
    return worst;
}

std::vector<sweep_layer> layers()
{
    std::vector<sweep_layer> result;
    for (const int half_range : {5, 10, 20})
        result.push_back({"fog_within_" + std::to_string(half_range),
                          "rays within " + std::to_string(half_range) + " degrees",
                          [=](double elevation, double falloff) { return error(elevation, falloff, half_range); }});
    return result;
}

const registered<sweep> entry{sweep{
    .id = "fog_row",
    .label = "Rows in height fog",
    .order = 220,
    .text = "A row across the light has the weights of its horizontal ray, in fog whose density falls by e over a "
            "scale height. The rays at the ends of its range look up and down. A quarter, half or three quarters of "
            "them are in shadow at first. The errors are those of the weights alone: the distribution of depths is "
            "exact.",
    .x = {"elevation", "elevation of the light in degrees", scale::linear, 0, 90, 19},
    .y = {"falloff", "length of the ray in scale heights of the fog", scale::log, 0.1, 30, 16},
    .error_label = "error",
    .threshold = 0.1,
    .layers = layers}};

} // namespace

} // namespace gnomon::evaluation::fog_row
