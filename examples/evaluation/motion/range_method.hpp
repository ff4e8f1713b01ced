// A method whose shadow map is of ranges. A kind of map is one file in maps/: a class with build(), or
// maps/rasterized_ranges.hpp with its options, registered with what is measured of it.
#pragma once

#include "motion_method.hpp"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gnomon::evaluation {

// Parameters of a map, the ids of the receivers that look it up, and the scenes in which they are measured.
struct range_variant {
    evaluation::parameters parameters{};
    std::vector<std::string> receivers;
    std::string tag{}; // only scenes with this tag; all where it is empty
    bool pictured = true;
};

struct range_method_facts {
    std::vector<range_variant> variants{};
    bool shared = false; // other maps start from this one
    bool curve = false;  // of memory and time, against cubes
};

class range_method : public motion_method {
  public:
    range_method(method_facts facts, range_method_facts of_ranges)
        : motion_method(std::move(facts)), of_ranges_(std::move(of_ranges))
    {}

    virtual range_shadow_map build(map_source& from, const evaluation::parameters& how) const = 0;

    void measure(motion_view& view, std::span<const std::string> tags, const outcome_sink& add) const final;
    std::optional<map_facts> costs(map_source& from) const final;
    bool is_shared() const { return of_ranges_.shared; }

  private:
    range_method_facts of_ranges_;
};

// True where a parameter is there and not 0.
bool is_set(const parameters& some, const std::string& name);

} // namespace gnomon::evaluation
