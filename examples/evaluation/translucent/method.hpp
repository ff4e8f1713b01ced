// Methods whose maps hold translucent occluders: how a map is built from opaque depths and translucent fragments, and how
// surfaces and smoke look it up.
#pragma once

#include "evaluation/core/method.hpp"
#include "occluders.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace gnomon::evaluation {

// The overestimation weight of a look-up (moments/bounds.h).
enum class bound {
    lower, // for surfaces, which show every light that is taken without cause
    middle // half the worst error, for layers in smoke
};

struct build_settings {
    colour of = colour::grey;
    float least_alpha = 0;  // of the alpha test
    std::uint32_t seed = 0; // of methods that draw fragments by chance
};

class translucent_map {
  public:
    virtual ~translucent_map() = default;

    virtual std::size_t bytes() const = 0; // with mip levels

    // Shadow intensities for one colour of light.
    virtual void intensities(std::span<const map_receiver> where, colour of, bound which,
                             std::span<float> result) const = 0;

    // Runs to time, as those of shadow_map, by the bound for surfaces.
    virtual std::vector<timed_look_up> timed(std::span<const map_receiver> where) const = 0;
};

struct translucent_traits {
    bool coloured = false;      // a look-up knows red, green and blue light, else grey light alone
    bool random = false;        // maps differ with the seed
    bool blended = false;       // fragments are blended, so that an alpha test removes some of the roundings
    bool between_bounds = true; // the look-up has both bounds, else there is one answer
};

class translucent_method : public method {
  public:
    using traits = translucent_traits;

    explicit translucent_method(method_facts facts, const traits& its_traits = {})
        : method(std::move(facts)), is(its_traits)
    {}

    virtual std::unique_ptr<translucent_map> build(const translucent_occluders& occluders, std::span<const float> taps,
                                                   const build_settings& how) const = 0;

    const traits is;
};

inline const registered<map_kind> translucent_map_kind{
    map_kind{.id = "translucent", .label = "filtered map of opaque and translucent occluders", .order = 30}};

} // namespace gnomon::evaluation
