// Soft shadows of two occluders: one far from the receiver with a wide penumbra, and one near to it, whose shadow is hard
// in the penumbra of the other. One mean blocker makes one penumbra of both (Peters et al. 2017, Fig. 10).
#include "rectangles.hpp"
#include "sweep.hpp"

#include <gnomon/moments/hamburger4.h>
#include <gnomon/soft/fusion.h>
#include <gnomon/storage/moments4_summed.hpp>
#include <gnomon/storage/moments6_summed.hpp>
#include <gnomon/storage/variance_summed.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace gnomon::evaluation::two_occluders {

namespace {

constexpr float search_texels = 784;
constexpr float ground = 0.95f;
constexpr int receivers = 65;

// Two walls with a gap between their edges, seen along a line of the map. Lengths are such that the penumbra of a wall is
// as wide as its distance from the receiver.
struct walls {
    double far_distance, near_distance, near_edge; // the far wall is before 0, the near one behind its edge

    float depth(double distance) const { return float(double(ground) - distance); }

    // The surfaces that the map shows in an interval about x.
    std::array<layer, 3> seen(double x, double width) const
    {
        const auto before = [&](double edge) { return std::clamp((edge - x) / width + 0.5, 0.0, 1.0); };
        const double far_share = before(0), gap_share = before(near_edge) - far_share;
        return {layer{depth(far_distance), float(far_share)},
                layer{depth(near_distance), float(1 - far_share - gap_share)}, layer{ground, float(gap_share)}};
    }

    // The share of the light that a receiver at x does not see: the walls hide it from either side.
    double exact(double x) const
    {
        const double far_share = std::clamp(0.5 - x / far_distance, 0.0, 1.0);
        return std::min(far_share + std::clamp(0.5 - (near_edge - x) / near_distance, 0.0, 1.0), 1.0);
    }
};

// The intensity for a receiver: of what the search interval and filter intervals show.
using soft_intensity = std::function<double(const walls&, double x)>;

double search_width() { return double(ground) + 1; }

double percentage_closer_soft(const walls& w, double x)
{
    const auto search = w.seen(x, search_width());
    const double width = std::max(double(ground) - exact_blocker(search, ground), 1e-6);
    return exact_intensity(w.seen(x, width), ground);
}

template <summed_table Table> format_channels<Table> channels_at(const walls& w, double x, double width)
{
    return rectangle_over<Table>(w.seen(x, width), double(search_texels), search_texels);
}

template <summed_table Table> double soft(const walls& w, double x)
{
    const float z_b = Table::blocker(channels_at<Table>(w, x, search_width()), search_texels, ground);
    const double width = std::max(double(ground - z_b), 1e-6);
    return double(Table::intensity(channels_at<Table>(w, x, width), search_texels, ground));
}

double fused(const walls& w, double x)
{
    using table = moments4_summed;
    const auto h = table::factor(channels_at<table>(w, x, search_width()), search_texels);
    const auto found = fusion_occluders(hamburger4_distribution(h, ground));
    const auto intensity = [&](float occluder, float z_f) {
        const double width = std::max(double(ground - occluder), 1e-6);
        return table::intensity(channels_at<table>(w, x, width), search_texels, z_f);
    };
    if (!(found.between > -1)) return double(intensity(found.second, ground));
    return double(fusion_intensity(intensity(found.first, found.between), intensity(found.second, found.between),
                                   intensity(found.second, ground)));
}

// Root mean square error over the penumbrae of both.
double error(const soft_intensity& found, double distance, double ratio)
{
    const walls w{distance, distance * ratio, distance / 4};
    const double first = -distance / 2, last = w.near_edge + std::max(distance, w.near_distance) / 2;
    double squares = 0;
    for (int i = 0; i < receivers; ++i) {
        const double x = first + (last - first) * (i + 0.5) / receivers;
        const double difference = found(w, x) - w.exact(x);
        squares += difference * difference;
    }
    return std::sqrt(squares / receivers);
}

sweep_layer shown(std::string id, const char* label, const soft_intensity& found)
{
    return {std::move(id), label, [found](double distance, double ratio) { return error(found, distance, ratio); }};
}

std::vector<sweep_layer> layers()
{
    return {shown("pcss", "PCSS", percentage_closer_soft),
            shown("variance_summed_soft", "VSM, 64 bit table", soft<variance_summed>),
            shown("moments4_summed_soft", "MSM, 128 bit table", soft<moments4_summed>),
            shown("moments6_summed_soft", "MSM6, 192 bit table", soft<moments6_summed>),
            shown("moments4_summed_fusion", "MSM, 128 bit table, two occluders", fused)};
}

const registered<sweep> entry{sweep{
    .id = "two_occluders",
    .label = "Soft shadows of two occluders",
    .order = 130,
    .text =
        "There is a gap between a wall far from the receiver and one near to it: in the wide penumbra of the far wall "
        "the edge of the near one casts a harder shadow. The exact intensity is the share of the light that either "
        "hides. The error is the root mean square over both penumbrae.",
    .x = {"distance", "distance of the farther wall from the receiver", scale::log, 0.01, 1.9, 24},
    .y = {"ratio", "distance of the nearer wall, as a share of that", scale::log, 0.02, 1, 16},
    .error_label = "root mean square error",
    .threshold = 0.1,
    .layers = layers}};

} // namespace

} // namespace gnomon::evaluation::two_occluders
