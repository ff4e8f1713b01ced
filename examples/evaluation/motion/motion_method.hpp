// Methods of shadows in motion as the registry knows them, and what they find in a scene.
#pragma once

#include "evaluation/core/report.hpp"
#include "motion_view.hpp"

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gnomon::evaluation {

// One method, map and kind of receiver in one scene.
struct motion_outcome {
    report_row row; // without its scene, reference and errors
    const renderer::seen_motion& seen;
    std::vector<float> visibility; // of each path of `seen`
    std::vector<float> unbiased{}; // the same without depth bias, or none
    std::string format{};          // for people
    bool pictured = true;          // in the gallery
};

class motion_method : public method {
  public:
    using method::method;
    using outcome_sink = std::function<void(const motion_outcome&)>;

    // Measures the maps and receivers of the method in a scene with these tags, and calls add for each.
    virtual void measure(motion_view& view, std::span<const std::string> tags, const outcome_sink& add) const = 0;

    // Memory and time of a map, for curves against cubes; none where the method has no curve.
    virtual std::optional<map_facts> costs(map_source&) const { return {}; }
};

// Bytes and time are per texel and per receiver; the label is the map's.
report_row row_of(const method& m, const map_facts& map);

} // namespace gnomon::evaluation
