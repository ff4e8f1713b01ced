// Storage formats of the filters beside moment shadow maps as types, with the interface of storage/moments_formats.hpp: what a
// texel is, how filtered values become one and come back, and the settings that belong to it.
//
//     using format = gnomon::exponential_variance_half;
//     format::texel t = format::encode(format::moments_of_depth(z));           // while rendering the map
//     float shadow = format::intensity(format::decode(t), z_f);                // filtered in between; floats or packs
#ifndef GNOMON_STORAGE_FILTERS_FORMATS_HPP
#define GNOMON_STORAGE_FILTERS_FORMATS_HPP

#include "../filters/convolution.h"
#include "../filters/exponential.h"
#include "../filters/exponential_variance.h"
#include "../filters/layered_variance.h"
#include "../filters/variance.h"
#include "../numerics/half.hpp"
#include "../numerics/unorm.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace gnomon {

/// The smallest minimum variance under which an error of the mean darkens a lit surface by at most 1%: Cantelli's bound
/// for one depth is e^2 / (minimum + e^2). An error has three roundings: rendering and two passes of a separable blur.
constexpr double minimum_variance_against(double rounding_of_depth)
{
    const double error = 3.0 * rounding_of_depth;
    return 99.0 * error * error;
}

/// 32 bits: two UNORM16 channels, (1 + mean) / 2 and the mean square.
struct variance_unorm16 {
    using moments = variance_moments<float>;
    using texel = std::array<std::uint16_t, 2>;
    static constexpr std::string_view method = "variance";
    static constexpr std::string_view name = "2x16 UNORM";
    static constexpr std::size_t bytes_per_texel = 4;
    static constexpr double minimum_variance = minimum_variance_against(1.0 / 65535.0);

    template <class Real> static variance_settings<Real> settings() { return {literal<Real>(minimum_variance)}; }
    static moments moments_of_depth(float z) { return variance_encode(z); }
    static texel encode_channels(moments c) { return {unorm_encode<16>(c.mean), unorm_encode<16>(c.square)}; }
    static texel encode(moments b) { return encode_channels({0.5f * b.mean + 0.5f, b.square}); }
    static moments decode(texel t) { return {unorm_decode<16>(t[0]), unorm_decode<16>(t[1])}; }
    template <class Real> static Real intensity(variance_moments<Real> channels, Real z_f)
    {
        channels.mean = Real(2) * channels.mean - Real(1);
        return variance_intensity(channels, z_f, settings<Real>());
    }
};

/// 32 bits: one float. exp(2 c) < 2^127.
struct exponential_float {
    using moments = exponential_moment<float>;
    using texel = std::array<float, 1>;
    static constexpr std::string_view method = "exponential";
    static constexpr std::string_view name = "1x32 float";
    static constexpr std::size_t bytes_per_texel = 4;
    static constexpr double exponent = 40;

    template <class Real> static exponential_settings<Real> settings() { return {literal<Real>(exponent)}; }
    static moments moments_of_depth(float z) { return exponential_encode(z, settings<float>()); }
    static texel encode_channels(moments c) { return {c.warped}; }
    static texel encode(moments b) { return encode_channels(b); }
    static moments decode(texel t) { return {t[0]}; }
    template <class Real> static Real intensity(exponential_moment<Real> channels, Real z_f)
    {
        return exponential_intensity(channels, z_f, settings<Real>());
    }
};

/// 64 bits: four half floats (Peters et al. 2017, Figure 4). A relative rounding of 2^-11 moves the depth by 2^-11 / c.
struct exponential_variance_half {
    using moments = exponential_variance_moments<float>;
    using texel = std::array<std::uint16_t, 4>;
    static constexpr std::string_view method = "exponential variance";
    static constexpr std::string_view name = "4x16 half";
    static constexpr std::size_t bytes_per_texel = 8;
    static constexpr double exponent = 5.54;
    static constexpr double minimum_variance = minimum_variance_against(0x1p-11 / exponent);

    template <class Real> static exponential_variance_settings<Real> settings()
    {
        return {literal<Real>(exponent), literal<Real>(exponent), literal<Real>(minimum_variance)};
    }
    static moments moments_of_depth(float z) { return exponential_variance_encode(z, settings<float>()); }
    static texel encode_channels(moments c)
    {
        return {half_encode(c.positive), half_encode(c.positive_square), half_encode(c.negative),
                half_encode(c.negative_square)};
    }
    static texel encode(moments b) { return encode_channels(b); }
    static moments decode(texel t)
    {
        return {half_decode(t[0]), half_decode(t[1]), half_decode(t[2]), half_decode(t[3])};
    }
    template <class Real> static Real intensity(exponential_variance_moments<Real> channels, Real z_f)
    {
        return exponential_variance_intensity(channels, z_f, settings<Real>());
    }
};

/// 128 bits: four floats (Peters et al. 2017, Figure 4). Depths are floats too, so their own rounding, 2^-24, comes on
/// top.
struct exponential_variance_float {
    using moments = exponential_variance_moments<float>;
    using texel = std::array<float, 4>;
    static constexpr std::string_view method = "exponential variance";
    static constexpr std::string_view name = "4x32 float";
    static constexpr std::size_t bytes_per_texel = 16;
    static constexpr double positive_exponent = 40;
    static constexpr double negative_exponent = 5.54;
    static constexpr double minimum_variance = minimum_variance_against(0x1p-24 + 0x1p-24 / negative_exponent);

    template <class Real> static exponential_variance_settings<Real> settings()
    {
        return {literal<Real>(positive_exponent), literal<Real>(negative_exponent), literal<Real>(minimum_variance)};
    }
    static moments moments_of_depth(float z) { return exponential_variance_encode(z, settings<float>()); }
    static texel encode_channels(moments c) { return {c.positive, c.positive_square, c.negative, c.negative_square}; }
    static texel encode(moments b) { return encode_channels(b); }
    static moments decode(texel t) { return {t[0], t[1], t[2], t[3]}; }
    template <class Real> static Real intensity(exponential_variance_moments<Real> channels, Real z_f)
    {
        return exponential_variance_intensity(channels, z_f, settings<Real>());
    }
};

/// The moments of four layers.
template <class Real> struct layered_variance_moments {
    static constexpr std::size_t layers = 4;
    std::array<variance_moments<Real>, layers> layer;
};

/// 128 bits: four layers that divide [-1, 1] evenly, each two UNORM16 channels, (1 + mean) / 2 and the mean square.
/// Where a surface passes from one layer to the next both are near 1, and their roundings, three of half a code each,
/// leave nothing of a small variance: 1 / 131070 from the square, twice 1 / 65535 from the mean.
struct layered_variance_unorm16 {
    using moments = layered_variance_moments<float>;
    using texel = std::array<std::uint16_t, 2 * moments::layers>;
    static constexpr std::string_view method = "layered variance";
    static constexpr std::string_view name = "8x16 UNORM";
    static constexpr std::size_t bytes_per_texel = 16;
    static constexpr double minimum_variance = 3.0 * (0.5 + 2.0) / 65535.0;

    template <class Real> static layered_variance_settings<Real> settings(std::size_t layer)
    {
        constexpr double scale = double(moments::layers);
        return {literal<Real>((2.0 * double(layer) + 1.0) / scale - 1.0), literal<Real>(scale),
                literal<Real>(minimum_variance)};
    }
    static moments moments_of_depth(float z)
    {
        moments b;
        for (std::size_t k = 0; k < moments::layers; ++k) b.layer[k] = layered_variance_encode(z, settings<float>(k));
        return b;
    }
    static texel encode_channels(const moments& c)
    {
        texel t;
        for (std::size_t k = 0; k < moments::layers; ++k) {
            t[2 * k] = unorm_encode<16>(c.layer[k].mean);
            t[2 * k + 1] = unorm_encode<16>(c.layer[k].square);
        }
        return t;
    }
    static texel encode(moments b)
    {
        for (auto& layer : b.layer) layer.mean = 0.5f * layer.mean + 0.5f;
        return encode_channels(b);
    }
    static moments decode(const texel& t)
    {
        moments c;
        for (std::size_t k = 0; k < moments::layers; ++k)
            c.layer[k] = {unorm_decode<16>(t[2 * k]), unorm_decode<16>(t[2 * k + 1])};
        return c;
    }
    template <class Real> static Real intensity(const layered_variance_moments<Real>& channels, Real z_f)
    {
        layered_variance<Real> state = layered_variance_begin(z_f);
        for (std::size_t k = 0; k < moments::layers; ++k) {
            variance_moments<Real> layer = channels.layer[k];
            layer.mean = Real(2) * layer.mean - Real(1);
            state = layered_variance_add(state, layer, settings<Real>(k));
        }
        return layered_variance_end(state);
    }
};

/// The cosines and sines of 16 terms.
template <class Real> struct convolution_series {
    static constexpr std::size_t terms = 16;
    std::array<Real, terms> cosine, sine;
};

/// 256 bits: 32 UNORM8 channels, (1 + value) / 2 (Annen et al. 2007; Klehm, Seidel & Eisemann 2014). Neither damped nor
/// sharpened.
struct convolution_unorm8 {
    using moments = convolution_series<float>;
    using texel = std::array<std::uint8_t, 2 * moments::terms>;
    static constexpr std::string_view method = "convolution";
    static constexpr std::string_view name = "32x8 UNORM";
    static constexpr std::size_t bytes_per_texel = 32;
    static constexpr double terms = double(moments::terms);
    static constexpr double span = 1.0 - 1.0 / terms;
    static constexpr double offset = 1.9264476603173706 / (3.1415926535897932 * terms * span);

    template <class Real> static convolution_settings<Real> settings()
    {
        return {literal<Real>(terms), Real(0), literal<Real>(offset), literal<Real>(span)};
    }
    static moments moments_of_depth(float z)
    {
        moments b;
        convolution_phase<float> phase = convolution_encode(z, settings<float>());
        for (std::size_t k = 0; k < moments::terms; ++k) {
            b.cosine[k] = phase.cosine;
            b.sine[k] = phase.sine;
            phase = convolution_next(phase);
        }
        return b;
    }
    static texel encode_channels(const moments& c)
    {
        texel t;
        for (std::size_t k = 0; k < moments::terms; ++k) {
            t[2 * k] = unorm_encode<8>(c.cosine[k]);
            t[2 * k + 1] = unorm_encode<8>(c.sine[k]);
        }
        return t;
    }
    static texel encode(moments b)
    {
        for (float& value : b.cosine) value = 0.5f * value + 0.5f;
        for (float& value : b.sine) value = 0.5f * value + 0.5f;
        return encode_channels(b);
    }
    static moments decode(const texel& t)
    {
        moments c;
        for (std::size_t k = 0; k < moments::terms; ++k) {
            c.cosine[k] = unorm_decode<8>(t[2 * k]);
            c.sine[k] = unorm_decode<8>(t[2 * k + 1]);
        }
        return c;
    }
    template <class Real> static Real intensity(const convolution_series<Real>& channels, Real z_f)
    {
        convolution_sum<Real> state = convolution_begin(z_f, settings<Real>());
        for (std::size_t k = 0; k < moments::terms; ++k) {
            const Real weight = literal<Real>(weights[k]);
            state = convolution_add(state, Real(2) * channels.cosine[k] - Real(1), Real(2) * channels.sine[k] - Real(1),
                                    weight);
        }
        return convolution_end(state);
    }

  private:
    static inline const std::array<double, moments::terms> weights = [] {
        std::array<double, moments::terms> w;
        for (std::size_t k = 0; k < w.size(); ++k) w[k] = convolution_weight(double(k + 1), settings<double>());
        return w;
    }();
};

} // namespace gnomon
#endif
