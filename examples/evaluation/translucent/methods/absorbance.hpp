// Maps of absorbance moments in floats, which need no order of fragments, beside a moment shadow map of the opaque occluders
// (moments/absorbance.h).
#pragma once

#include "evaluation/translucent/blended.hpp"

#include <gnomon/moments/absorbance.h>
#include <gnomon/storage/formats.hpp>

#include <string_view>
#include <type_traits>

namespace gnomon::evaluation {

// Absorbance of red and green light; mean is that of all three colours, to which the moments belong.
template <class Real> struct coloured_absorbance4 {
    absorbance4<Real> mean;
    Real red, green;
};

// The share of the light that surfaces in front of z_f absorb.
template <class Real> Real absorbing_share(bound which, const absorbance4<Real>& b, Real roundings, Real z_f)
{
    const Real in_floats = literal<Real>(blended_float_roundings) * roundings;
    const auto bias = bias_weight_of_roundings(literal<Real>(stored4_float_weight), Real(1) + in_floats);
    const hankel4<Real> factor = absorbance4_factor(b, bias);
    return which == bound::lower ? hamburger4_lower(factor, z_f)
                                 : bounds_intensity(hamburger4_bounds(factor, z_f), Real(0.5));
}

// Floats of absorbance, as the passes filter them. The depths of a map are those of opaque surfaces, which absorb nothing
// here.
template <class Format, template <class...> class Channels>
struct absorbance_floats : stored_texel<Format, float_texel<Channels>> {
    static constexpr double darkening = stored4_float_weight, filtered_darkening = stored4_float_filtered_weight;

    template <class Real> static constexpr Channels<Real> from_depth(Real) { return {}; }
    template <class Real> static Real filtered_intensity(const Channels<Real>& c, std::type_identity_t<Real> z_f)
    {
        const absorbance4<Real>& mean = Format::mean(c);
        return Real(1) - absorbance_transmittance(mean.b0, absorbing_share(bound::lower, mean, Real(2), z_f));
    }
    template <class Real> static Real intensity(const Channels<Real>& c, std::type_identity_t<Real> z_f)
    {
        return filtered_intensity(c, z_f);
    }
};

struct grey_absorbance : absorbance_floats<grey_absorbance, absorbance4> {
    static constexpr std::string_view name = "5 x float, beside 4x16 UNORM", id = "absorbance4_float";

    template <class Real> static const absorbance4<Real>& mean(const absorbance4<Real>& c) { return c; }
    template <class Real> static Real absorbance(const absorbance4<Real>& c, colour) { return c.b0; }
    static absorbance4<float> of(float z, const glm::vec3& opacity)
    {
        return absorbance4_of_fragment(z, opacity_for(colour::grey, opacity));
    }
};

struct coloured_absorbance : absorbance_floats<coloured_absorbance, coloured_absorbance4> {
    static constexpr std::string_view name = "7 x float, beside 4x16 UNORM", id = "absorbance4_float_coloured";

    template <class Real> static const absorbance4<Real>& mean(const coloured_absorbance4<Real>& c) { return c.mean; }
    template <class Real> static Real absorbance(const coloured_absorbance4<Real>& c, colour of)
    {
        switch (of) {
            case colour::red:
                return c.red;
            case colour::green:
                return c.green;
            case colour::blue:
                return gnomon_max(Real(0), Real(3) * c.mean.b0 - (c.red + c.green));
            default:
                return c.mean.b0;
        }
    }
    static coloured_absorbance4<float> of(float z, const glm::vec3& opacity)
    {
        const float red = absorbance_of_opacity(opacity.r), green = absorbance_of_opacity(opacity.g);
        const float mean = (red + green + absorbance_of_opacity(opacity.b)) / 3;
        const moments4<float> b = moments4_from_depth(z);
        return {{mean, mean * b.b1, mean * b.b2, mean * b.b3, mean * b.b4}, red, green};
    }
};

template <class Format> class absorbance_map final : public translucent_map {
  public:
    template <class Real> struct channels {
        channels4<Real> opaque;
        format_channels<Format, Real> translucent;
    };

    absorbance_map(const translucent_occluders& occluders, std::span<const float> taps, const build_settings& how)
        : roundings_(2 + static_cast<float>(occluders.fragments(colour::grey).layers)),
          opaque_(occluders.opaque, taps),
          translucent_(occluders.opaque, taps, [&](map_view<typename Format::texel> map) {
              for (std::size_t i = 0; i < map.texels.size(); ++i)
                  for (const renderer::fragment& f : occluders.translucent(i)) {
                      if (opacity_for(colour::grey, f.opacity) < how.least_alpha) continue;
                      auto sum = load_channels<Format>(map.texels[i]);
                      const auto more = std::bit_cast<channel_array<Format>>(Format::of(f.depth, f.opacity));
                      for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += more[k];
                      map.texels[i] = store_channels<Format>(sum);
                  }
          })
    {}

    std::size_t bytes() const override { return opaque_.bytes() + translucent_.bytes(); }

    void intensities(std::span<const map_receiver> where, colour of, bound which,
                     std::span<float> result) const override
    {
        for (std::size_t i = 0; i < where.size(); ++i) {
            const channels<float> c = fetch(where[i]);
            result[i] = shadow(c, shares(c, which, roundings_, where[i].depth), of);
        }
    }

    std::vector<timed_look_up> timed(std::span<const map_receiver> where) const override
    {
        return timed_look_ups<channels>(
            where, [this](const map_receiver& r) { return fetch(r); },
            [roundings = roundings_]<class Real>(const channels<Real>& c, Real z_f) {
                const auto found = shares(c, bound::lower, Real(roundings), z_f);
                if constexpr (std::is_same_v<Format, grey_absorbance>) return shadow(c, found, colour::grey);
                else
                    return literal<Real>(1. / 3) * (shadow(c, found, colour::red) + shadow(c, found, colour::green) +
                                                    shadow(c, found, colour::blue));
            });
    }

  private:
    template <class Real> struct taken {
        Real by_opaque, of_absorbance;
    };

    channels<float> fetch(const map_receiver& where) const { return {opaque_.fetch(where), translucent_.fetch(where)}; }

    // Opaque occluders are few in a filter region: all receivers take the lower bound on their shadow.
    template <class Real> static taken<Real> shares(const channels<Real>& c, bound which, Real roundings, Real z_f)
    {
        return {moments4_unorm16::filtered_intensity(c.opaque, z_f),
                absorbing_share(which, Format::mean(c.translucent), roundings, z_f)};
    }
    template <class Real> static Real shadow(const channels<Real>& c, const taken<Real>& t, colour of)
    {
        const Real left = absorbance_transmittance(Format::absorbance(c.translucent, of), t.of_absorbance);
        return Real(1) - (Real(1) - t.by_opaque) * left;
    }

    float roundings_;
    filtered_map<moments4_unorm16> opaque_;
    filtered_map<Format> translucent_;
};

template <class Format> class absorbance_method final : public translucent_method {
  public:
    absorbance_method(method_facts facts, const translucent_traits& its_traits)
        : translucent_method(completed(std::move(facts)), its_traits)
    {}

    std::unique_ptr<translucent_map> build(const translucent_occluders& occluders, std::span<const float> taps,
                                           const build_settings& how) const override
    {
        return std::make_unique<absorbance_map<Format>>(occluders, taps, how);
    }

  private:
    static method_facts completed(method_facts facts)
    {
        facts.map = translucent_map_kind->id;
        facts.format = facts_of_format<Format>();
        facts.format.bytes_per_texel += moments4_unorm16::bytes_per_texel;
        return facts;
    }
};

} // namespace gnomon::evaluation
