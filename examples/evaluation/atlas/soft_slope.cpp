// A lit plane that is seen at a slope, under the filters of soft shadows, with a depth bias of half the filter's width and
// with half a texel more: a rectangle reads texels that it touches as a whole.
#include "rectangles.hpp"
#include "sweep.hpp"

#include <gnomon/storage/moments4_summed.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace gnomon::evaluation::soft_slope {

namespace {

constexpr float most_texels = 784;
constexpr int places = 16; // of the receiver in a texel

// The texels of the plane in an interval about x, each by the share of the interval that lies in it.
std::vector<layer> plane(double slope, double x, double width)
{
    const double begin = x - width / 2, end = x + width / 2;
    std::vector<layer> result;
    for (double texel = std::floor(begin); texel < end; ++texel)
        result.push_back(
            {float(slope * (texel + 0.5)), float((std::min(end, texel + 1) - std::max(begin, texel)) / width)});
    return result;
}

// The darkest receiver.
template <class Intensity> double darkest(double slope, double width, double reach, Intensity intensity)
{
    double worst = 0;
    for (int i = 0; i < places; ++i) {
        const double x = (i + 0.5) / places;
        worst = std::max(worst, double(intensity(plane(slope, x, width), float(slope * (x - reach)))));
    }
    return worst;
}

double percentage_closer(const std::vector<layer>& region, float z_f) { return exact_intensity(region, z_f); }

float moments(const std::vector<layer>& region, float z_f)
{
    using table = moments4_summed;
    return table::intensity(rectangle_over<table>(region, double(most_texels), most_texels), most_texels, z_f);
}

template <class Intensity> sweep_layer shown(const char* id, const char* label, double more, Intensity intensity)
{
    return {id, label, [=](double slope, double width) { return darkest(slope, width, width / 2 + more, intensity); }};
}

std::vector<sweep_layer> layers()
{
    return {shown("pcss_half_width", "PCSS, half the width", 0, percentage_closer),
            shown("pcss_half_texel_more", "PCSS, half a texel more", 0.5, percentage_closer),
            shown("moments4_summed_half_width", "MSM, 128 bit table, half the width", 0, moments),
            shown("moments4_summed_half_texel_more", "MSM, 128 bit table, half a texel more", 0.5, moments)};
}

const registered<sweep> entry{
    sweep{.id = "soft_slope",
          .label = "Slope of a lit plane under soft shadows",
          .order = 140,
          .text = "A lit plane fills the filter of a soft shadow; its depth changes from texel to texel. The receiver "
                  "lies on the plane, nearer by the depth bias of half the width of the filter, or of half a texel "
                  "more. Any intensity darkens a lit surface.",
          .x = {"slope", "change of depth per texel", scale::log, 1e-4, 0.2, 28},
          .y = {"width", "width of the filter in texels", scale::log, 1, 27, 16},
          .error_label = "shadow on a lit plane",
          .threshold = 0.02,
          .layers = layers}};

} // namespace

} // namespace gnomon::evaluation::soft_slope
