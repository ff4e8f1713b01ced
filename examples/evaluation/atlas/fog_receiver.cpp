// A layer of fog that receives the shadow of the layers before it: depths are spread evenly, which few moments bound
// loosely.
#include "fog.hpp"
#include "sweep.hpp"

#include <gnomon/moments/bounds.h>
#include <gnomon/storage/formats.hpp>

#include <cmath>
#include <cstddef>
#include <vector>

namespace gnomon::evaluation::fog_receiver {

namespace {

constexpr int count = 30;
constexpr float back = 0.8f;
constexpr double nearest = -0.6, farthest = 0.6;

std::vector<pane> fog(double opacity)
{
    const auto each = float(-std::expm1(std::log1p(-opacity) / count));
    std::vector<pane> result;
    for (int i = 0; i < count; ++i) result.push_back({float(farthest + (nearest - farthest) * i / (count - 1)), each});
    return result;
}

template <storage_format Format> hamburger_bounds<float> bounds_of(const auto& factor, float z_f)
{
    if constexpr (channel_count<Format> == 4) return hamburger4_bounds(factor, z_f);
    else return hamburger6_bounds(factor, z_f);
}

// Overestimation is 1 for the lower bound, 1/2 for the middle.
template <storage_format Format> intensity_at_depth moments_of(const std::vector<pane>& panes, float overestimation)
{
    const auto factor =
        Format::blended_factor(blended<Format>(panes, back), blend_roundings_of_layers(panes[0].opacity, float(count)));
    return [=](float z_f) { return bounds_intensity(bounds_of<Format>(factor, z_f), overestimation); };
}

template <absorbance_format Format>
intensity_at_depth absorbance_of(const std::vector<pane>& panes, float overestimation)
{
    return [=, c = accumulated<Format>(panes)](float z_f) {
        return 1 - Format::transmittance(c, float(count), overestimation, z_f);
    };
}

intensity_at_depth variance_of(const std::vector<pane>& panes, float)
{
    return [c = blended<variance_unorm16>(panes, back)](float z_f) { return variance_unorm16::intensity(c, z_f); };
}

sweep_layer shown(const char* id, const char* label, float overestimation,
                  intensity_at_depth (*kept)(const std::vector<pane>&, float))
{
    return {id, label, [=](double place, double opacity) {
                const std::vector<pane> panes = fog(opacity);
                const float z_f = panes[std::size_t(std::lround((1 - place) * (count - 1)))].depth;
                return std::abs(double(kept(panes, overestimation)(z_f)) - exact_intensity(panes, back, z_f));
            }};
}

std::vector<sweep_layer> layers()
{
    return {shown("variance_lower", "VSM 32 bit, lower bound", 1, variance_of),
            shown("moments4_lower", "MSM 64 bit, lower bound", 1, moments_of<moments4_unorm16>),
            shown("moments4_middle", "MSM 64 bit, middle of the bounds", 0.5f, moments_of<moments4_unorm16>),
            shown("moments6_lower", "MSM6 96 bit, lower bound", 1, moments_of<moments6_unorm16>),
            shown("moments6_middle", "MSM6 96 bit, middle of the bounds", 0.5f, moments_of<moments6_unorm16>),
            shown("absorbance4_lower", "absorbance, lower bound", 1, absorbance_of<absorbance4_float>),
            shown("absorbance4_middle", "absorbance, middle of the bounds", 0.5f, absorbance_of<absorbance4_float>)};
}

const registered<sweep> entry{sweep{
    .id = "fog_receiver",
    .label = "Receivers in fog",
    .order = 100,
    .text = "Thirty layers of equal opacity fill a slab in front of an opaque surface. The receiver is one of "
            "them. The exact intensity is the opacity of the layers before it.",
    .x = {"place", "place of the receiver, from the near side of the fog to the far side", scale::linear, 0, 1, 30},
    .y = {"opacity", "opacity of the whole fog", scale::linear, 0.06, 0.99, 16},
    .error_label = "error",
    .threshold = 0.1,
    .layers = layers}};

} // namespace

} // namespace gnomon::evaluation::fog_receiver
