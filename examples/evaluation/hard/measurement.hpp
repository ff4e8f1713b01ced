// One method on one stage: what it shows, and what it costs.
#pragma once

#include "evaluation/core/timed_look_ups.hpp"
#include "shaded_stage.hpp"

#include <vector>

namespace gnomon::evaluation {

struct measurement {
    double build_ms = 0, map_bytes = 0;
    std::vector<float> visibility, unbiased; // per receiver, and without depth bias
    std::vector<measured_time> times;
};

measurement measure(const shadow_method& m, const shaded_stage& stage);

} // namespace gnomon::evaluation
