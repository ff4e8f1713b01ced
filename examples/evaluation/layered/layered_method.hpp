// Methods of shadows in motion for a stochastic camera, each of whose samples has a time of its own, as the registry
// knows them. A method is one file in methods/: a class with build(), registered with the variants that are measured.
#pragma once

#include "evaluation/motion/slices.hpp"
#include "layered_input.hpp"
#include "stochastic_receivers.hpp"

#include <gnomon/motion/receiver/shutter.h>

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::evaluation {

// A map that look-ups read. They bias depths by the slopes of receivers, whose depths have no bias.
class layered_map {
  public:
    virtual ~layered_map() = default;

    virtual std::size_t bytes() const = 0; // of all that look-ups read

    // The visibility of one receiver after the other, on one thread.
    virtual void visibilities(std::span<const stochastic_receiver> where, std::span<float> result) const = 0;

    // The part of the shutter interval over which a look-up averages visibility: all of it, where not overridden.
    virtual shutter_exposure<float> averaged(const stochastic_receiver&) const { return {0, 1}; }

    // Side lengths of the map, in whose texels receivers have to be.
    int resolution = 0;
    // Milliseconds of one core: what the light sees, such as samples or ranges, and what the method makes of it.
    double sampling_ms = 0, conversion_ms = 0;
    // Facts for the page, such as layers per tile, by their names.
    evaluation::parameters facts{};
};

// Parameters of build(), and the comparisons that show the variant.
struct layered_variant {
    evaluation::parameters parameters{};
    std::string label{}; // for people, behind the method's; none where it is empty
    // Ids of comparisons, see below. The first variant of a method is its usual one.
    std::vector<std::string> comparisons{};
    std::string without{}; // a tag of scenes in which it takes too long for all but the full run
    std::string scene{};   // the one that the quick run shows a setting in; those with the tag "settings" where empty
};

// Comparisons by their ids: of the same samples of map and camera, which is that of the usual variant of each method; of
// rivals of the usual layers that may have about their time or about their memory, in scenes with the tag "rivals"; and of
// settings of one method, in scenes with the tag "settings". The full run has all of them in all scenes.
inline constexpr const char* equal_input = "input";
inline constexpr const char* equal_time = "time";
inline constexpr const char* equal_memory = "memory";
inline constexpr const char* of_settings = "settings";

// The layers that others are compared with.
inline constexpr const char* usual_layers = "layered_variance";

// The visibility of the light at the time of each sample, whose noise is the camera's alone.
inline constexpr const char* exact_method = "exact_visibility";

class layered_method : public method {
  public:
    // Maps that are not seeded are the same for each seed of their input, and are built once.
    layered_method(method_facts facts, std::vector<layered_variant> its_variants, bool seeded = true)
        : method(std::move(facts)), variants(std::move(its_variants)), is_seeded(seeded)
    {}

    virtual std::unique_ptr<layered_map> build(layered_input& from, const evaluation::parameters& how) const = 0;

    const std::vector<layered_variant> variants;
    const bool is_seeded;
};

// The parameter, or another value where there is none.
double value_of(const parameters& some, const std::string& name, double otherwise);

// Shared by files of methods: families, a kind of map each, and the receivers of rows.
inline const registered<family> deep_family{
    family{.id = "deep", .label = "deep shadow maps", .order = 220, .colour = "#9467bd"}};
inline const registered<family> layers_family{
    family{.id = "layers", .label = "layered filtered shadow maps", .order = 230, .colour = "#1f77b4"}};
inline const registered<family> footprints_family{
    family{.id = "footprints", .label = "ranges over footprints", .order = 240, .colour = "#2ca02c"}};
inline const registered<map_kind> deep_kind{map_kind{.id = "deep", .label = "deep shadow maps", .order = 140}};
inline const registered<map_kind> layers_kind{map_kind{.id = "layers", .label = "layers of tiles", .order = 150}};
inline const registered<receiver_kind> camera_samples_kind{
    receiver_facts{.id = "camera_samples", .label = "samples of the camera", .order = 160, .marker = "circle"}};

} // namespace gnomon::evaluation
