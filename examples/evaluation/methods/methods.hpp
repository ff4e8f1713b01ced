// Every shadow filter that the drivers compare, with one shape:
//
//     M::map map(depths, taps);                            // from the depths of a multisampled shadow map
//     M::fetched texel = M::fetch(map, place, z_f);        // what texture units do
//     float shadow = M::intensity(texel, z_f);             // what the shader does: the kernel that is timed
//
// Filterable methods do the last step for packs too: M::intensity(M::moments_of<pack>, pack).
#pragma once

#include "evaluation/core/filtered_map.hpp"
#include "evaluation/methods/raised_pivots4.hpp"

#include <gnomon/comparators/hamburger_cholesky.h>
#include <gnomon/moments/hamburger4.h>
#include <gnomon/storage/filters_formats.hpp>
#include <gnomon/storage/moments_formats.hpp>

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <span>
#include <string_view>
#include <tuple>

namespace gnomon::evaluation {

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

template <class M>
concept packable = method<M> && requires
{
    typename M::template moments_of<float>;
};

// Percentage-closer filtering has no filterable map: its look-up is its kernel.
struct pcf {
    static constexpr std::string_view name = "PCF", format = "4 samples of 32 bit depth";
    static constexpr std::size_t bytes_per_texel = sizeof(depth_map::pixels[0]);

    struct map {
        map(const depth_map& d, std::span<const float> t) : depths(d), taps(t) {}

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
        return percentage_closer_intensity<float>(f.source->depths, f.place, z_f, f.source->taps);
    }
};

// A filterable map in a format of the library, by default with the reconstruction that belongs to the format once two
// passes have filtered it.
template <class Format, template <class...> class Moments> struct filterable {
    static constexpr std::string_view format = Format::name;
    static constexpr std::size_t bytes_per_texel = Format::bytes_per_texel;
    template <class Real> using moments_of = Moments<Real>;
    using fetched = Moments<float>;
    using storage = Format;
    using map = filtered_map<Format>;

    static fetched fetch(const map& source, const look_up& place) { return source.fetch(place); }

    template <class Real> static Real intensity(const Moments<Real>& filtered, Real z_f)
    {
        if constexpr (requires { Format::filtered_intensity(filtered, z_f); })
            return Format::filtered_intensity(filtered, z_f);
        else return Format::intensity(filtered, z_f);
    }
};

struct vsm_32 : filterable<variance_unorm16, variance_moments> {
    static constexpr std::string_view name = "VSM 32 bit";
};

struct lvsm_128 : filterable<layered_variance_unorm16, layered_variance_moments> {
    static constexpr std::string_view name = "LVSM 128 bit";
};

struct esm_32 : filterable<exponential_float, exponential_moment> {
    static constexpr std::string_view name = "ESM 32 bit";
};

struct evsm_64 : filterable<exponential_variance_half, exponential_variance_moments> {
    static constexpr std::string_view name = "EVSM 64 bit";
};

struct evsm_128 : filterable<exponential_variance_float, exponential_variance_moments> {
    static constexpr std::string_view name = "EVSM 128 bit";
};

struct csm_256 : filterable<convolution_unorm8, convolution_series> {
    static constexpr std::string_view name = "CSM 256 bit";
};

// Peters et al. 2017, Figure 4b, with Algorithm 1 as it stands there, as in all methods named after the paper.
struct msm_64_paper : filterable<moments4_unorm16, moments4> {
    static constexpr std::string_view name = "MSM 64 bit (paper)";
    template <class Real> static Real intensity(const moments4<Real>& f, Real z_f)
    {
        const auto b = theta4_inverse(f);
        const auto biased = moments4_add_bias(b, literal<Real>(bias4_theta_paper_b2),
                                              literal<Real>(bias4_theta_paper_b4), literal<Real>(6e-5));
        return hamburger4_cholesky_intensity(biased, z_f);
    }
};

struct msm_64 : filterable<moments4_unorm16, moments4> {
    static constexpr std::string_view name = "MSM 64 bit";
};

struct msm_64_half : filterable<moments4_half, moments4> {
    static constexpr std::string_view name = "MSM 64 bit half";
};

// The default until it was found to darken lit surfaces (docs/decisions/2-bias.md).
struct msm_64_raised : filterable<moments4_unorm16, moments4> {
    static constexpr std::string_view name = "MSM 64 bit, raised pivots";
    template <class Real> static Real intensity(const moments4<Real>& f, Real z_f)
    {
        return hamburger4_lower(bench::hankel4_raised_from(moments4_unorm16{}, f), z_f);
    }
};

// Moments of depth in [0, 1], as moment shadow maps had them before signed depth (Figure 4d).
struct moments4_unit_float : moments4_float {
    static moments moments_of_depth(float z) { return moments4_from_depth(0.5f * z + 0.5f); }
};

struct msm_128_unit : filterable<moments4_unit_float, moments4> {
    static constexpr std::string_view name = "MSM 128 bit, depth in [0, 1]";
    template <class Real> static Real intensity(moments4<Real> b, Real z_f)
    {
        for (Real* moment : {&b.b1, &b.b2, &b.b3, &b.b4})
            *moment = *moment + literal<Real>(2e-6) * (Real(0.5f) - *moment);
        return hamburger4_cholesky_intensity(b, Real(0.5f) * z_f + Real(0.5f));
    }
};

// Figure 4f.
struct msm_128_paper : filterable<moments4_float, moments4> {
    static constexpr std::string_view name = "MSM 128 bit (paper)";
    template <class Real> static Real intensity(const moments4<Real>& f, Real z_f)
    {
        const auto biased = moments4_add_bias(f, literal<Real>(bias4_raw_paper_b2), literal<Real>(bias4_raw_paper_b4),
                                              literal<Real>(3e-7));
        return hamburger4_cholesky_intensity(biased, z_f);
    }
};

struct msm_128 : filterable<moments4_float, moments4> {
    static constexpr std::string_view name = "MSM 128 bit";
};

struct msm6_60 : filterable<moments6_unorm10, moments6> {
    static constexpr std::string_view name = "MSM6 60 bit";
};

struct msm6_96 : filterable<moments6_unorm16, moments6> {
    static constexpr std::string_view name = "MSM6 96 bit";
};

struct msm6_192 : filterable<moments6_float, moments6> {
    static constexpr std::string_view name = "MSM6 192 bit";
};

using all_methods =
    std::tuple<pcf, vsm_32, lvsm_128, esm_32, evsm_64, evsm_128, csm_256, msm_64_paper, msm_64, msm_64_raised,
               msm_64_half, msm_128_unit, msm_128_paper, msm_128, msm6_60, msm6_96, msm6_192>;

// Calls each.template operator()<M>() for every method.
template <class Each> void for_each_method(Each each)
{
    [&]<method... M>(std::tuple<M...>*) { (each.template operator()<M>(), ...); }
    (static_cast<all_methods*>(nullptr));
}

} // namespace gnomon::evaluation
