// Every shadow filter that the drivers compare, with one shape:
//
//     M::map map(depths, taps);                            // from the depths of a multisampled shadow map
//     M::fetched texel = M::fetch(map, place, z_f);        // what texture units do
//     float shadow = M::intensity(texel, z_f);             // what the shader does: the kernel that is timed
#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <gnomon/moments/formats.hpp>
#include <span>
#include <string_view>
#include <tuple>

#include "filtered_map.hpp"

namespace gnomon::demo {

template <class M>
concept method = requires(const depth_map& depths, std::span<const float> taps, const look_up& place, float z_f,
                          const typename M::map& map, const typename M::fetched& fetched)
{
    {
        M::name
        } -> std::convertible_to<std::string_view>;
    {
        M::format
        } -> std::convertible_to<std::string_view>;
    {
        M::bytes_per_texel
        } -> std::convertible_to<std::size_t>;
    (typename M::map{depths, taps});
    {
        M::fetch(map, place)
        } -> std::same_as<typename M::fetched>;
    {
        M::intensity(fetched, z_f)
        } -> std::same_as<float>;
};

// Percentage-closer filtering has no filterable map: its look-up is its kernel.
struct pcf {
    static constexpr std::string_view name = "PCF", format = "4 samples of 32 bit depth";
    static constexpr std::size_t bytes_per_texel = sizeof(depth_map::pixels[0]);

    struct map {
        const depth_map& depths;
        std::span<const float> taps;
    };
    struct fetched {
        const map* source;
        look_up place;
    };

    static fetched fetch(const map& source, const look_up& place) { return {&source, place}; }
    static float intensity(const fetched& f, float z_f)
    {
        return percentage_closer<float>(f.source->depths, f.place, z_f, f.source->taps);
    }
};

// Storage of moments: the library's formats speak of moments4 and moments6, filters of arrays.
template <class Format> struct moment_storage {
    static constexpr std::string_view format = Format::name;
    static constexpr std::size_t bytes_per_texel = Format::bytes_per_texel;
    using moments = typename Format::moments;
    using texel = typename Format::texel;
    using channels = std::array<float, sizeof(moments) / sizeof(float)>;

    static channels of_depth(float z)
    {
        if constexpr (sizeof(moments) == sizeof(moments4<float>))
            return std::bit_cast<channels>(Format::channels(moments4_of_depth(z)));
        else return std::bit_cast<channels>(Format::channels(moments6_of_depth(z)));
    }
    static texel encode(const channels& c) { return Format::encode_channels(std::bit_cast<moments>(c)); }
    static channels decode(const texel& t) { return std::bit_cast<channels>(Format::decode(t)); }
};

// Moments of depth in [0, 1], as moment shadow maps had them before signed depth.
struct unit_moment_storage : moment_storage<moments4_float> {
    static channels of_depth(float z) { return std::bit_cast<channels>(moments4_of_depth(0.5f * z + 0.5f)); }
};

template <storage S> struct filterable : S {
    using map = filtered_map<S>;
    using fetched = typename S::channels;
    static fetched fetch(const map& source, const look_up& place) { return source.trilinear(place); }
};

// The library's default for a format: its transform, its bias, its bias weight.
template <class Format> struct moment_method : filterable<moment_storage<Format>> {
    static float intensity(const auto& c, float z_f)
    {
        const auto factored = Format::factor(std::bit_cast<typename Format::moments>(c));
        if constexpr (requires { hamburger4_lower(factored, z_f); }) return hamburger4_lower(factored, z_f);
        else return hamburger6_lower(factored, z_f);
    }
};

struct moments4_64_paper : filterable<moment_storage<moments4_unorm16>> {
    static constexpr std::string_view name = "Moments, 64 bit (paper's bias)";
    static float intensity(const channels& c, float z_f)
    {
        const auto b = theta4_inverse(std::bit_cast<moments4<float>>(c));
        return hamburger4_lower(hankel4_fast(moments4_biased(b, 0.628f, 0.628f, 6e-5f)), z_f);
    }
};

struct moments4_64 : moment_method<moments4_unorm16> {
    static constexpr std::string_view name = "Moments, 64 bit";
};

struct moments4_128_unit : filterable<unit_moment_storage> {
    static constexpr std::string_view name = "Moments, 128 bit, depth in [0, 1] (2015)";
    static float intensity(const channels& c, float z_f)
    {
        auto b = std::bit_cast<moments4<float>>(c);
        const float alpha = 2e-6f;
        for (float* channel : {&b.b1, &b.b2, &b.b3, &b.b4}) *channel += alpha * (0.5f - *channel);
        return hamburger4_lower(hankel4_fast(b), 0.5f * z_f + 0.5f);
    }
};

struct moments4_128_paper : filterable<moment_storage<moments4_float>> {
    static constexpr std::string_view name = "Moments, 128 bit (paper's bias)";
    static float intensity(const channels& c, float z_f)
    {
        const auto b = std::bit_cast<moments4<float>>(c);
        return hamburger4_lower(hankel4_fast(moments4_biased(b, 0.375f, 0.375f, 3e-7f)), z_f);
    }
};

struct moments4_128 : moment_method<moments4_float> {
    static constexpr std::string_view name = "Moments, 128 bit";
};

struct moments6_60 : moment_method<moments6_unorm10> {
    static constexpr std::string_view name = "Six moments, 60 bit";
};

struct moments6_96 : moment_method<moments6_unorm16> {
    static constexpr std::string_view name = "Six moments, 96 bit";
};

struct moments6_192 : moment_method<moments6_float> {
    static constexpr std::string_view name = "Six moments, 192 bit";
};

using all_methods = std::tuple<pcf, moments4_64_paper, moments4_64, moments4_128_unit, moments4_128_paper, moments4_128,
                               moments6_60, moments6_96, moments6_192>;

// Calls each.template operator()<M>() for every method.
template <class Each> void for_each_method(Each each)
{
    [&]<method... M>(std::tuple<M...>*) { (each.template operator()<M>(), ...); }
    (static_cast<all_methods*>(nullptr));
}

} // namespace gnomon::demo
