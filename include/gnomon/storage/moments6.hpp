// Shadow maps of six moments: the storage formats as types.
//
// Beside what every format has: from_moments transforms moments; factor and filtered_factor give the matrix with a
// constant bias, of the vector bias and the weight bias_weight or filtered_bias_weight, for both bounds.
#ifndef GNOMON_STORAGE_MOMENTS6_HPP
#define GNOMON_STORAGE_MOMENTS6_HPP

#include "format.hpp"
#include "moments6.h"
#include "moments6_blended.h"

GNOMON_NAMESPACE_BEGIN

/// Six UNORM10 channels, three to a 10-10-10-2 word, the first channel of a word lowest.
struct unorm10_words {
    template <class Real> using channels = channels6<Real>;
    using texel = std::array<std::uint32_t, 2>;
    static constexpr std::size_t bytes_per_texel = sizeof(texel);

    static constexpr texel encode(const channels6<float>& c)
    {
        return {word_of(c.c1, c.c2, c.c3), word_of(c.c4, c.c5, c.c6)};
    }
    static constexpr channels6<float> decode(const texel& t)
    {
        return {field(t[0], 0), field(t[0], 10), field(t[0], 20), field(t[1], 0), field(t[1], 10), field(t[1], 20)};
    }
    static void encode_row(const float* numbers, texel* to, std::size_t count)
    {
        constexpr std::size_t block = 16;
        std::array<std::uint16_t, 6 * block> codes{};
        for (std::size_t done = 0; done < count; done += block) {
            const std::size_t texels = (std::min)(block, count - done);
            unorm_encode_row<10>(numbers + 6 * done, codes.data(), 6 * texels);
            for (std::size_t i = 0; i < texels; ++i)
                to[done + i] = {packed(codes.data() + 6 * i), packed(codes.data() + 6 * i + 3)};
        }
    }
    static void decode_row(const texel* from, float* numbers, std::size_t count)
    {
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t w = 0; w < 2; ++w, numbers += 3) {
                // A field as it stands in its word, over the largest number there: the quotient of decode.
                const std::uint32_t word = from[i][w];
                numbers[0] = float(std::int32_t(word & 1023u)) / 1023.0f;
                numbers[1] = float(std::int32_t(word & 1023u << 10)) / (1023.0f * 0x1p10f);
                numbers[2] = float(std::int32_t(word & 1023u << 20)) / (1023.0f * 0x1p20f);
            }
    }

  private:
    static constexpr std::uint32_t packed(const std::uint16_t* codes)
    {
        return std::uint32_t{codes[0]} | std::uint32_t{codes[1]} << 10 | std::uint32_t{codes[2]} << 20;
    }
    static constexpr std::uint32_t word_of(float a, float b, float c)
    {
        return std::uint32_t{unorm_encode<10>(a)} | std::uint32_t{unorm_encode<10>(b)} << 10 |
               std::uint32_t{unorm_encode<10>(c)} << 20;
    }
    static constexpr float field(std::uint32_t w, int shift) { return unorm_decode<10>(w >> shift & 1023u); }
};

/// 64 bits, of which 60 are used: six UNORM10 channels after theta6.
struct moments6_unorm10 : stored_texel<moments6_unorm10, unorm10_words> {
    static constexpr std::string_view name = "6x10 UNORM", id = "moments6_unorm10";
    static constexpr double darkening = stored6_unorm10_weight, filtered_darkening = stored6_unorm10_filtered_weight;

    template <class Real> static constexpr channels<Real> from_depth(Real z) { return moments6_unorm10_encode(z); }
    template <class Real> static constexpr Real intensity(const channels<Real>& c, std::type_identity_t<Real> z_f)
    {
        return moments6_unorm10_intensity(c, z_f);
    }
    template <class Real>
    static constexpr Real filtered_intensity(const channels<Real>& c, std::type_identity_t<Real> z_f)
    {
        return moments6_unorm10_filtered_intensity(c, z_f);
    }

    static constexpr std::array<double, 3> bias = {bias6_theta_b2, bias6_theta_b4, bias6_theta_b6};
    static constexpr double bias_weight = stored6_unorm10_weight,
                            filtered_bias_weight = stored6_unorm10_filtered_weight;

    template <class Real> static constexpr channels<Real> from_moments(const moments6<Real>& b) { return theta6(b); }
    template <class Real> static constexpr hankel6<Real> factor(const channels<Real>& c)
    {
        return hankel6_from_unorm10(c);
    }
    template <class Real> static constexpr hankel6<Real> filtered_factor(const channels<Real>& c)
    {
        return hankel6_from_unorm10_filtered(c);
    }

    template <class Real>
    static constexpr Real blended_intensity(const channels<Real>& c, std::type_identity_t<Real> roundings,
                                            std::type_identity_t<Real> z_f)
    {
        return moments6_unorm10_blended_intensity(c, roundings, z_f);
    }
    template <class Real>
    static constexpr hankel6<Real> blended_factor(const channels<Real>& c, std::type_identity_t<Real> roundings)
    {
        return hankel6_from_unorm10_blended(c, roundings);
    }
};
static_assert(storage_format<moments6_unorm10>);

/// 96 bits: six UNORM16 channels after theta6.
struct moments6_unorm16 : stored_texel<moments6_unorm16, unorm_texel<channels6, 16>> {
    static constexpr std::string_view name = "6x16 UNORM", id = "moments6_unorm16";
    static constexpr double darkening = stored6_unorm16_weight, filtered_darkening = stored6_unorm16_filtered_weight;

    template <class Real> static constexpr channels<Real> from_depth(Real z) { return moments6_unorm16_encode(z); }
    template <class Real> static constexpr Real intensity(const channels<Real>& c, std::type_identity_t<Real> z_f)
    {
        return moments6_unorm16_intensity(c, z_f);
    }
    template <class Real>
    static constexpr Real filtered_intensity(const channels<Real>& c, std::type_identity_t<Real> z_f)
    {
        return moments6_unorm16_filtered_intensity(c, z_f);
    }

    static constexpr std::array<double, 3> bias = {bias6_theta_b2, bias6_theta_b4, bias6_theta_b6};
    static constexpr double bias_weight = stored6_unorm16_weight,
                            filtered_bias_weight = stored6_unorm16_filtered_weight;

    template <class Real> static constexpr channels<Real> from_moments(const moments6<Real>& b) { return theta6(b); }
    template <class Real> static constexpr hankel6<Real> factor(const channels<Real>& c)
    {
        return hankel6_from_unorm16(c);
    }
    template <class Real> static constexpr hankel6<Real> filtered_factor(const channels<Real>& c)
    {
        return hankel6_from_unorm16_filtered(c);
    }

    template <class Real>
    static constexpr Real blended_intensity(const channels<Real>& c, std::type_identity_t<Real> roundings,
                                            std::type_identity_t<Real> z_f)
    {
        return moments6_unorm16_blended_intensity(c, roundings, z_f);
    }
    template <class Real>
    static constexpr hankel6<Real> blended_factor(const channels<Real>& c, std::type_identity_t<Real> roundings)
    {
        return hankel6_from_unorm16_blended(c, roundings);
    }
};
static_assert(storage_format<moments6_unorm16>);

/// 192 bits: six floats.
struct moments6_float : stored_texel<moments6_float, float_texel<channels6>> {
    static constexpr std::string_view name = "6x32 float", id = "moments6_float";
    static constexpr double darkening = stored6_float_weight, filtered_darkening = stored6_float_filtered_weight;

    template <class Real> static constexpr channels<Real> from_depth(Real z) { return moments6_float_encode(z); }
    template <class Real> static constexpr Real intensity(const channels<Real>& c, std::type_identity_t<Real> z_f)
    {
        return moments6_float_intensity(c, z_f);
    }
    template <class Real>
    static constexpr Real filtered_intensity(const channels<Real>& c, std::type_identity_t<Real> z_f)
    {
        return moments6_float_filtered_intensity(c, z_f);
    }

    static constexpr std::array<double, 3> bias = {bias6_raw_b2, bias6_raw_b4, bias6_raw_b6};
    static constexpr double bias_weight = stored6_float_weight, filtered_bias_weight = stored6_float_filtered_weight;

    template <class Real> static constexpr channels<Real> from_moments(const moments6<Real>& b)
    {
        return channels6_from_moments(b);
    }
    template <class Real> static constexpr hankel6<Real> factor(const channels<Real>& c)
    {
        return hankel6_from_float(c);
    }
    template <class Real> static constexpr hankel6<Real> filtered_factor(const channels<Real>& c)
    {
        return hankel6_from_float_filtered(c);
    }

    template <class Real>
    static constexpr Real blended_intensity(const channels<Real>& c, std::type_identity_t<Real> roundings,
                                            std::type_identity_t<Real> z_f)
    {
        return moments6_float_blended_intensity(c, roundings, z_f);
    }
    template <class Real>
    static constexpr hankel6<Real> blended_factor(const channels<Real>& c, std::type_identity_t<Real> roundings)
    {
        return hankel6_from_float_blended(c, roundings);
    }
};
static_assert(storage_format<moments6_float>);

GNOMON_NAMESPACE_END
#endif
