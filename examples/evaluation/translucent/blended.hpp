// A filterable map in a storage format into which translucent fragments are blended from back to front before two passes
// filter it. A method is a file that registers blended<RULE>. A rule has
//
//     format                         of the map
//     lower(channels, roundings, z_f)     the shadow intensity for surfaces
//     bounds(channels, roundings, z_f)    both bounds on it
//
// roundings are those that blends and filter passes leave in a texel.
#pragma once

#include "evaluation/core/filtered_map.hpp"
#include "evaluation/core/timed_look_ups.hpp"
#include "method.hpp"

#include <gnomon/moments/bounds.h>
#include <gnomon/moments/translucency.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::evaluation {

// What is left of the roundings of all blends of fragments, with this alpha test, and of two filter passes.
inline float roundings_of(const coloured_fragments& blended, float least_alpha)
{
    const float filter_passes = 2;
    if (blended.layers == 0) return filter_passes;
    return filter_passes +
           blend_roundings_of_layers(std::max(least_alpha, blended.least_alpha), static_cast<float>(blended.layers));
}

template <class Rule, class Real>
Real shadow(bound which, const format_channels<typename Rule::format, Real>& channels, Real roundings, Real z_f)
{
    if (which == bound::lower) return Rule::lower(channels, roundings, z_f);
    return bounds_intensity(Rule::bounds(channels, roundings, z_f), Real(0.5));
}

template <class Rule> class blended_map final : public translucent_map {
  public:
    using format = typename Rule::format;
    template <class Real> using channels = format_channels<format, Real>;

    blended_map(const translucent_occluders& occluders, std::span<const float> taps, const build_settings& how)
        : roundings_(roundings_of(occluders.fragments(how.of), how.least_alpha)),
          map_(occluders.opaque, taps, [&](map_view<typename format::texel> map) {
              blend<format>(map, occluders.fragments(how.of).back_to_front, how.least_alpha);
          })
    {}

    // A map of depths alone.
    blended_map(const depth_map& depths, std::span<const float> taps)
        : roundings_(roundings_of({}, 0)), map_(depths, taps)
    {}

    std::size_t bytes() const override { return map_.bytes(); }
    float roundings() const { return roundings_; }
    channels<float> fetch(const map_receiver& where) const { return map_.fetch(where); }

    void intensities(std::span<const map_receiver> where, colour, bound which, std::span<float> result) const override
    {
        for (std::size_t i = 0; i < where.size(); ++i)
            result[i] = shadow<Rule, float>(which, map_.fetch(where[i]), roundings_, where[i].depth);
    }

    std::vector<timed_look_up> timed(std::span<const map_receiver> where) const override
    {
        return timed_look_ups<channels>(
            where, [this](const map_receiver& r) { return map_.fetch(r); },
            [roundings = roundings_]<class Real>(const channels<Real>& filtered, Real z_f) {
                return Rule::lower(filtered, Real(roundings), z_f);
            });
    }

  private:
    float roundings_;
    filtered_map<format> map_;
};

template <class Format> storage_facts facts_of_format()
{
    return {std::string(Format::id), std::string(Format::name), double(Format::bytes_per_texel)};
}

template <class Rule> class blended final : public translucent_method {
  public:
    explicit blended(method_facts facts) : translucent_method(completed(std::move(facts)), {.blended = true}) {}

    std::unique_ptr<translucent_map> build(const translucent_occluders& occluders, std::span<const float> taps,
                                           const build_settings& how) const override
    {
        return std::make_unique<blended_map<Rule>>(occluders, taps, how);
    }

  private:
    static method_facts completed(method_facts facts)
    {
        facts.map = translucent_map_kind->id;
        facts.format = facts_of_format<typename Rule::format>();
        return facts;
    }
};

} // namespace gnomon::evaluation
