// The exact depth distribution of each texel, opaque samples under translucent fragments, and its transmittance under the
// weights that maps are filtered with.
#pragma once

#include "evaluation/core/receivers.hpp"
#include "occluders.hpp"

#include <glm/vec4.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace gnomon::evaluation {

// A value for each colour of light, in the order of the enumeration.
using of_colours = glm::dvec4;

class texel_stacks {
  public:
    explicit texel_stacks(const translucent_occluders& occluders);

    // The share of light that is taken before depth z_f.
    of_colours intensity(int x, int y, float z_f) const;

    // Its weighted mean over the filter region of a look-up.
    of_colours filtered_intensity(const map_receiver& where, std::span<const float> taps) const;

  private:
    int width_, height_;
    std::vector<std::uint32_t> first_; // of the steps of each texel
    std::vector<float> depths_;        // of the steps, ascending
    std::vector<glm::vec4> taken_;     // of light by a step and those before it
};

} // namespace gnomon::evaluation
