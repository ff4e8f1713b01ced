// The largest rectangle of a summed-area table: the more texels it may cover, the fewer bits each channel has.
#include "rectangles.hpp"
#include "sweep.hpp"

#include <gnomon/moments/hamburger4.h>
#include <gnomon/storage/moments4_summed.hpp>
#include <gnomon/storage/moments6_summed.hpp>
#include <gnomon/storage/variance_summed.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace gnomon::evaluation::largest_rectangle {

namespace {

constexpr double leak_allowed = 0.1, darkening_allowed = 0.02;

// Of the largest rectangle about two surfaces, at many depths and in equal and unequal shares: the larger error, in
// multiples of what is allowed, of a receiver on either.
template <class Intensity> double error(double side, double distance, Intensity intensity)
{
    const float most_texels = float((side + 1) * (side + 1));
    double worst = 0;
    for (int i = 0; i < 16; ++i) {
        const auto near_depth = float(-0.95 + (1.9 - distance) * std::fmod(0.6180339887 * (i + 0.5), 1));
        const float far_depth = float(double(near_depth) + distance);
        for (const double wanted : {0.1, 0.5}) {
            const double share = std::max(std::round(wanted * double(most_texels)), 1.0) / double(most_texels);
            const std::array region{layer{near_depth, float(share)}, layer{far_depth, float(1 - share)}};
            worst = std::max({worst, double(intensity(region, most_texels, near_depth)) / darkening_allowed,
                              (double(intensity(region, most_texels, far_depth)) - share) / darkening_allowed,
                              (share - double(intensity(region, most_texels, far_depth))) / leak_allowed});
        }
    }
    return worst;
}

template <summed_table Table> sweep_layer of_table(const char* label)
{
    return {std::string(Table::id), label, [](double side, double distance) {
                return error(side, distance, [](std::span<const layer> region, float most_texels, float z_f) {
                    const auto c = rectangle_over<Table>(region, double(most_texels), most_texels);
                    return Table::intensity(c, most_texels, z_f);
                });
            }};
}

// The bias of Peters et al. (2017, Sec. 4.2) for searches of 27 x 27 texels, at every size.
float paper_intensity(std::span<const layer> region, float most_texels, float z_f)
{
    const auto c = rectangle_over<moments4_summed>(region, double(most_texels), most_texels);
    return hamburger4_lower(
        hankel4_constant_bias(theta4_inverse(c), float(bias4_theta_b2), float(bias4_theta_b4), 6e-7f), z_f);
}

std::vector<sweep_layer> layers()
{
    return {of_table<variance_summed>("VSM, 64 bit table"),
            {"moments4_summed_paper", "MSM, 128 bit table, bias for 27 x 27",
             [](double side, double distance) { return error(side, distance, paper_intensity); }},
            of_table<moments4_summed>("MSM, 128 bit table"),
            of_table<moments6_summed>("MSM6, 192 bit table")};
}

const registered<sweep> entry{sweep{
    .id = "summed_table",
    .label = "Largest rectangle of a summed-area table",
    .order = 110,
    .text = "A table of 32-bit sums leaves the fewer bits to a channel the more texels a look-up may cover. The "
            "largest rectangle covers two surfaces. A method fails where a receiver on the farther one is 0.1 too "
            "light, or one on either 0.02 too dark. Each point is the worst of surfaces at many depths.",
    .x = {"side", "side of the largest rectangle in texels", scale::log, 3, 1000, 25},
    .y = {"distance", "distance of the surfaces", scale::log, 1e-5, 1.5, 24},
    .error_label = "error in multiples of what is allowed",
    .threshold = 1,
    .layers = layers}};

} // namespace

} // namespace gnomon::evaluation::largest_rectangle
