// Fog: many translucent surfaces in a texel, as each way of keeping them in a map answers for their shadow.
#pragma once

#include "evaluation/core/method.hpp"
#include "sweep.hpp"

#include <gnomon/passes/blend.hpp>

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::evaluation {

// A fragment of a translucent surface: its signed depth and its opacity.
struct pane {
    float depth, opacity;
};

// 1 less the transmittance of the panes in front of depth z_f; 1 behind the opaque surface at depth back.
double exact_intensity(std::span<const pane> panes, float back, float z_f);

using intensity_at_depth = std::function<float(float z_f)>;

// A way to keep panes, given from back to front, and an opaque surface behind them: the shadow intensity from what it has
// kept. roundings is what blends are allowed, as by blend_roundings_of_layers.
struct fog_map {
    std::string id, label;
    std::function<intensity_at_depth(std::span<const pane> panes, float back, float roundings)> kept;
};

// Channels of the panes blended one by one over the opaque surface, every result stored.
filterable_method::channels blended(const filterable_method& m, std::span<const pane> panes, float back);

// The fragments of panes in a map of one texel.
std::vector<translucent_fragment> fragments_of(std::span<const pane> panes);

// Channels of the panes blended by the library's pass, in a map of one texel.
template <storage_format Format> format_channels<Format> blended(std::span<const pane> panes, float back)
{
    format_texel<Format> texel = Format::encode(Format::from_depth(back));
    blend<Format>({{&texel, 1}, 1, 1}, fragments_of(panes));
    return Format::decode(texel);
}

// Channels of the panes' absorbance. The opaque surface is in a map of its own.
template <absorbance_format Format> format_channels<Format> accumulated(std::span<const pane> panes)
{
    format_texel<Format> texel = Format::clear();
    accumulate<Format>({{&texel, 1}, 1, 1}, fragments_of(panes));
    return Format::decode(texel);
}

// Every filterable method as it is, every format of moments by its function for blended maps, and sums of absorbance.
std::vector<fog_map> fog_maps();

// Slabs of fog, from thin to thick, since roundings depend on depth as if by chance; of panes of these opacities from back
// to front, of which those below least_opacity are not drawn.
struct fog_errors {
    double leak;      // the most light that is too much on the surface behind the fog
    double darkening; // the most shadow that is too much on a receiver before, in or behind the fog
};
fog_errors errors_in_fog(const fog_map& m, std::span<const float> opacities, float least_opacity);

// The larger of both errors, each in multiples of the least one that fails: a leak of 0.1 and a darkening of 0.02.
double fog_error(const fog_map& m, std::span<const float> opacities, float least_opacity);

// A layer for each fog map.
std::vector<sweep_layer> layers_of_fog_maps(const std::function<double(const fog_map&, double x, double y)>& error);

} // namespace gnomon::evaluation
