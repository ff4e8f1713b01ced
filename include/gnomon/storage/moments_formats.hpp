// Storage formats of moment shadow maps as types, for maps in main memory: what a texel is, how moments become one and
// come back, and the transform and reconstruction that belong to it (storage/moments4.h, storage/moments6.h), so that a map, its filter
// and its reconstruction cannot be mismatched.
//
//     using format = gnomon::moments4_unorm16;
//     format::texel t = format::encode(gnomon::moments4_from_depth(z));          // while rendering the map
//     float shadow = format::intensity(format::decode(t), z_f);                // filtered in between; floats or packs
//
// decode returns what a texture unit would: the channels, still transformed, since filtering is linear in them.
// intensity allows for one rounding, filtered_intensity for a filter of two passes that stores its results in the
// format; darkening and filtered_darkening are the most that either exceeds the truth by. factor and filtered_factor
// give the matrix with a constant bias, of the vector bias and the weight bias_weight or filtered_bias_weight, for both
// bounds.
#ifndef GNOMON_STORAGE_MOMENTS_FORMATS_HPP
#define GNOMON_STORAGE_MOMENTS_FORMATS_HPP

#include "../moments/hamburger4.h"
#include "../moments/hamburger6.h"
#include "../numerics/half.hpp"
#include "../numerics/unorm.hpp"
#include "moments4.h"
#include "moments6.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

namespace gnomon {

/// 64 bits: four UNORM16 channels after theta4.
struct moments4_unorm16 {
    using moments = moments4<float>;
    using texel = std::array<std::uint16_t, 4>;
    static constexpr std::string_view name = "4x16 UNORM";
    static constexpr std::size_t bytes_per_texel = 8;
    static constexpr std::array<double, 2> bias = {bias4_theta_b2, bias4_theta_b4};
    static constexpr double bias_weight = stored4_unorm16_weight;
    static constexpr double filtered_bias_weight = stored4_unorm16_filtered_weight;
    static constexpr double darkening = stored4_arithmetic_weight;
    static constexpr double filtered_darkening = stored4_arithmetic_weight;

    static moments channels(moments b) { return theta4(b); }
    static texel encode_channels(moments c)
    {
        return {unorm_encode<16>(c.b1), unorm_encode<16>(c.b2), unorm_encode<16>(c.b3), unorm_encode<16>(c.b4)};
    }
    static texel encode(moments b) { return encode_channels(channels(b)); }
    static moments decode(texel t)
    {
        return {unorm_decode<16>(t[0]), unorm_decode<16>(t[1]), unorm_decode<16>(t[2]), unorm_decode<16>(t[3])};
    }
    template <class Real> static hankel4<Real> factor(moments4<Real> c) { return hankel4_from_unorm16(c); }
    template <class Real> static hankel4<Real> filtered_factor(moments4<Real> c)
    {
        return hankel4_from_unorm16_filtered(c);
    }
    template <class Real> static Real intensity(moments4<Real> c, std::type_identity_t<Real> z_f)
    {
        return certified4_unorm16(c, z_f);
    }
    template <class Real> static Real filtered_intensity(moments4<Real> c, std::type_identity_t<Real> z_f)
    {
        return certified4_unorm16_filtered(c, z_f);
    }
};

/// 64 bits: four half floats.
struct moments4_half {
    using moments = moments4<float>;
    using texel = std::array<std::uint16_t, 4>;
    static constexpr std::string_view name = "4x16 half";
    static constexpr std::size_t bytes_per_texel = 8;
    static constexpr std::array<double, 2> bias = {bias4_raw_b2, bias4_raw_b4};
    static constexpr double bias_weight = stored4_half_weight;
    static constexpr double filtered_bias_weight = stored4_half_filtered_weight;
    static constexpr double darkening = stored4_arithmetic_weight;
    static constexpr double filtered_darkening = stored4_arithmetic_weight;

    static moments channels(moments b) { return b; }
    static texel encode_channels(moments b)
    {
        return {half_encode(b.b1), half_encode(b.b2), half_encode(b.b3), half_encode(b.b4)};
    }
    static texel encode(moments b) { return encode_channels(b); }
    static moments decode(texel t)
    {
        return {half_decode(t[0]), half_decode(t[1]), half_decode(t[2]), half_decode(t[3])};
    }
    template <class Real> static hankel4<Real> factor(moments4<Real> b) { return hankel4_from_half(b); }
    template <class Real> static hankel4<Real> filtered_factor(moments4<Real> b)
    {
        return hankel4_from_half_filtered(b);
    }
    template <class Real> static Real intensity(moments4<Real> b, std::type_identity_t<Real> z_f)
    {
        return certified4_half(b, z_f);
    }
    template <class Real> static Real filtered_intensity(moments4<Real> b, std::type_identity_t<Real> z_f)
    {
        return certified4_half_filtered(b, z_f);
    }
};

/// 128 bits: four floats.
struct moments4_float {
    using moments = moments4<float>;
    using texel = std::array<float, 4>;
    static constexpr std::string_view name = "4x32 float";
    static constexpr std::size_t bytes_per_texel = 16;
    static constexpr std::array<double, 2> bias = {bias4_raw_b2, bias4_raw_b4};
    static constexpr double bias_weight = stored4_float_weight;
    static constexpr double filtered_bias_weight = stored4_float_filtered_weight;
    static constexpr double darkening = stored4_arithmetic_weight;
    static constexpr double filtered_darkening = stored4_arithmetic_weight;

    static moments channels(moments b) { return b; }
    static texel encode_channels(moments b) { return {b.b1, b.b2, b.b3, b.b4}; }
    static texel encode(moments b) { return encode_channels(b); }
    static moments decode(texel t) { return {t[0], t[1], t[2], t[3]}; }
    template <class Real> static hankel4<Real> factor(moments4<Real> b) { return hankel4_from_float(b); }
    template <class Real> static hankel4<Real> filtered_factor(moments4<Real> b)
    {
        return hankel4_from_float_filtered(b);
    }
    template <class Real> static Real intensity(moments4<Real> b, std::type_identity_t<Real> z_f)
    {
        return certified4_float(b, z_f);
    }
    template <class Real> static Real filtered_intensity(moments4<Real> b, std::type_identity_t<Real> z_f)
    {
        return certified4_float_filtered(b, z_f);
    }
};

/// 64 bits, of which 60 are used: six UNORM10 channels after theta6, three to a 10-10-10-2 word, first channel lowest.
struct moments6_unorm10 {
    using moments = moments6<float>;
    using texel = std::array<std::uint32_t, 2>;
    static constexpr std::string_view name = "6x10 UNORM";
    static constexpr std::size_t bytes_per_texel = 8;
    static constexpr std::array<double, 3> bias = {bias6_theta_b2, bias6_theta_b4, bias6_theta_b6};
    static constexpr double bias_weight = stored6_unorm10_weight;
    static constexpr double filtered_bias_weight = stored6_unorm10_filtered_weight;
    static constexpr double darkening = stored6_unorm10_weight;
    static constexpr double filtered_darkening = stored6_unorm10_filtered_weight;

    static moments channels(moments b) { return theta6(b); }
    static texel encode_channels(moments c) { return {word(c.b1, c.b2, c.b3), word(c.b4, c.b5, c.b6)}; }
    static texel encode(moments b) { return encode_channels(channels(b)); }
    static moments decode(texel t)
    {
        return {field(t[0], 0), field(t[0], 10), field(t[0], 20), field(t[1], 0), field(t[1], 10), field(t[1], 20)};
    }
    template <class Real> static hankel6<Real> factor(moments6<Real> c) { return hankel6_from_unorm10(c); }
    template <class Real> static hankel6<Real> filtered_factor(moments6<Real> c)
    {
        return hankel6_from_unorm10_filtered(c);
    }
    template <class Real> static Real intensity(moments6<Real> c, std::type_identity_t<Real> z_f)
    {
        return hamburger6_lower(factor(c), z_f);
    }
    template <class Real> static Real filtered_intensity(moments6<Real> c, std::type_identity_t<Real> z_f)
    {
        return hamburger6_lower(filtered_factor(c), z_f);
    }

  private:
    static std::uint32_t word(float a, float b, float c)
    {
        return std::uint32_t{unorm_encode<10>(a)} | std::uint32_t{unorm_encode<10>(b)} << 10 |
               std::uint32_t{unorm_encode<10>(c)} << 20;
    }
    static float field(std::uint32_t w, int shift) { return unorm_decode<10>(w >> shift & 1023u); }
};

/// 96 bits: six UNORM16 channels after theta6.
struct moments6_unorm16 {
    using moments = moments6<float>;
    using texel = std::array<std::uint16_t, 6>;
    static constexpr std::string_view name = "6x16 UNORM";
    static constexpr std::size_t bytes_per_texel = 12;
    static constexpr std::array<double, 3> bias = {bias6_theta_b2, bias6_theta_b4, bias6_theta_b6};
    static constexpr double bias_weight = stored6_unorm16_weight;
    static constexpr double filtered_bias_weight = stored6_unorm16_filtered_weight;
    static constexpr double darkening = stored6_unorm16_weight;
    static constexpr double filtered_darkening = stored6_unorm16_filtered_weight;

    static moments channels(moments b) { return theta6(b); }
    static texel encode_channels(moments c)
    {
        return {unorm_encode<16>(c.b1), unorm_encode<16>(c.b2), unorm_encode<16>(c.b3),
                unorm_encode<16>(c.b4), unorm_encode<16>(c.b5), unorm_encode<16>(c.b6)};
    }
    static texel encode(moments b) { return encode_channels(channels(b)); }
    static moments decode(texel t)
    {
        return {unorm_decode<16>(t[0]), unorm_decode<16>(t[1]), unorm_decode<16>(t[2]),
                unorm_decode<16>(t[3]), unorm_decode<16>(t[4]), unorm_decode<16>(t[5])};
    }
    template <class Real> static hankel6<Real> factor(moments6<Real> c) { return hankel6_from_unorm16(c); }
    template <class Real> static hankel6<Real> filtered_factor(moments6<Real> c)
    {
        return hankel6_from_unorm16_filtered(c);
    }
    template <class Real> static Real intensity(moments6<Real> c, std::type_identity_t<Real> z_f)
    {
        return hamburger6_lower(factor(c), z_f);
    }
    template <class Real> static Real filtered_intensity(moments6<Real> c, std::type_identity_t<Real> z_f)
    {
        return hamburger6_lower(filtered_factor(c), z_f);
    }
};

/// 192 bits: six floats.
struct moments6_float {
    using moments = moments6<float>;
    using texel = std::array<float, 6>;
    static constexpr std::string_view name = "6x32 float";
    static constexpr std::size_t bytes_per_texel = 24;
    static constexpr std::array<double, 3> bias = {bias6_raw_b2, bias6_raw_b4, bias6_raw_b6};
    static constexpr double bias_weight = stored6_float_weight;
    static constexpr double filtered_bias_weight = stored6_float_filtered_weight;
    static constexpr double darkening = stored6_float_weight;
    static constexpr double filtered_darkening = stored6_float_filtered_weight;

    static moments channels(moments b) { return b; }
    static texel encode_channels(moments b) { return {b.b1, b.b2, b.b3, b.b4, b.b5, b.b6}; }
    static texel encode(moments b) { return encode_channels(b); }
    static moments decode(texel t) { return {t[0], t[1], t[2], t[3], t[4], t[5]}; }
    template <class Real> static hankel6<Real> factor(moments6<Real> b) { return hankel6_from_float(b); }
    template <class Real> static hankel6<Real> filtered_factor(moments6<Real> b)
    {
        return hankel6_from_float_filtered(b);
    }
    template <class Real> static Real intensity(moments6<Real> b, std::type_identity_t<Real> z_f)
    {
        return hamburger6_lower(factor(b), z_f);
    }
    template <class Real> static Real filtered_intensity(moments6<Real> b, std::type_identity_t<Real> z_f)
    {
        return hamburger6_lower(filtered_factor(b), z_f);
    }
};

} // namespace gnomon
#endif
