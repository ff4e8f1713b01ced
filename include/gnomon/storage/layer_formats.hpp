// Texels of layers (motion/layers/layer_sums.h) as storage formats: sums over samples, of which linear filters are sums
// again. A cleared texel has weight 0, no information. They hold no single depth, so they are no storage_format.
//
//     using format = gnomon::layer_variance_float;
//     sums = format::add(sums, z, share);                          while accumulating samples, z the layer's own depth
//     float through = format::visibility(sums, z_r, noise);        of a receiver through a layer
#ifndef GNOMON_STORAGE_LAYER_FORMATS_HPP
#define GNOMON_STORAGE_LAYER_FORMATS_HPP

#include "../motion/layers/layer_sums.h"
#include "format.hpp"

#include <tuple>

GNOMON_NAMESPACE_BEGIN

/// Functions that every format of a layer has beside those of its texel:
///     add(channels, z, share)               the sums with one more sample
///     visibility(channels, z, variance)     through the layer, with a least variance of the layer's own depths
///     least_variance                        of the layer's own depths, which hides the roundings of the format
// clang-format off
template <class Format> concept layer_format = texel_format<Format> && requires(const format_channels<Format>& c, float z,
                                                                               const layer_share<float>& s) {
    { Format::add(c, z, s) } -> std::same_as<format_channels<Format>>;
    { Format::visibility(c, z, z) } -> std::same_as<float>;
    { c.opacity } -> std::convertible_to<float>;
    { c.weight } -> std::convertible_to<float>;
    { Format::least_variance } -> std::convertible_to<double>;
};
// clang-format on

/// Functions of the sums of two moments.
struct layer_variance_sums {
    template <class Real>
    static constexpr layer_sums<Real> add(const layer_sums<Real>& c, std::type_identity_t<Real> z,
                                          const layer_share<std::type_identity_t<Real>>& share)
    {
        return layer_sums_add(c, z, share);
    }
    template <class Real>
    static constexpr Real visibility(const layer_sums<Real>& c, std::type_identity_t<Real> z,
                                     std::type_identity_t<Real> variance)
    {
        return layer_visibility(c, z, variance);
    }
};

/// 128 bits: two moments of depth, opacity and weight as floats.
struct layer_variance_float : zeroed_texel<float_texel<layer_sums>>, layer_variance_sums {
    static constexpr std::string_view name = "4x32 float", id = "layer_variance_float";
    static constexpr double least_variance = 0x1p-20;
};
static_assert(layer_format<layer_variance_float>);

/// 64 bits: two moments of depth, opacity and weight as half floats.
struct layer_variance_half : zeroed_texel<half_texel<layer_sums>>, layer_variance_sums {
    static constexpr std::string_view name = "4x16 half", id = "layer_variance_half";
    static constexpr double least_variance = 0x1p-9;
};
static_assert(layer_format<layer_variance_half>);

/// 192 bits: four moments of depth, opacity and weight as floats.
struct layer_moments4_float : zeroed_texel<float_texel<layer_moments4_sums>> {
    static constexpr std::string_view name = "6x32 float", id = "layer_moments4_float";
    static constexpr double least_variance = 0; // the bias of the moments hides roundings
    static constexpr double roundings = 64;     // of sums and by filters; as many as samples where these are more

    template <class Real>
    static constexpr channels<Real> add(const channels<Real>& c, std::type_identity_t<Real> z,
                                        const layer_share<std::type_identity_t<Real>>& share)
    {
        return layer_moments4_add(c, z, share);
    }
    template <class Real>
    static constexpr Real visibility(const channels<Real>& c, std::type_identity_t<Real> z, std::type_identity_t<Real>)
    {
        return layer_moments4_visibility(c, z, gnomon_max(Real(roundings), c.weight));
    }
};
static_assert(layer_format<layer_moments4_float>);

/// Functions of the sums of a warped depth.
struct layer_exponential_functions {
    static constexpr double least_variance = 0; // Markov's bound needs none
    static constexpr double exponent = 40;      // exp(2 c) < 2^127

    template <class Real>
    static constexpr layer_exponential_sums<Real> add(const layer_exponential_sums<Real>& c,
                                                      std::type_identity_t<Real> z,
                                                      const layer_share<std::type_identity_t<Real>>& share)
    {
        return layer_exponential_add(c, z, share, {Real(exponent)});
    }
    template <class Real>
    static constexpr Real visibility(const layer_exponential_sums<Real>& c, std::type_identity_t<Real> z,
                                     std::type_identity_t<Real>)
    {
        return layer_exponential_visibility(c, z, {Real(exponent)});
    }
};

/// 96 bits: a warped depth, opacity and weight as floats.
struct layer_exponential_float : zeroed_texel<float_texel<layer_exponential_sums>>, layer_exponential_functions {
    static constexpr std::string_view name = "3x32 float", id = "layer_exponential_float";
};
static_assert(layer_format<layer_exponential_float>);

using layer_formats =
    std::tuple<layer_variance_float, layer_variance_half, layer_moments4_float, layer_exponential_float>;

GNOMON_NAMESPACE_END
#endif
