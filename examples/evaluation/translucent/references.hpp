// What visibility is compared with: the exact transmittance of the blended stacks under the weights of the filter, and ray
// tracing.
#pragma once

#include "stacks.hpp"
#include "view.hpp"

#include <array>
#include <span>
#include <string>

namespace gnomon::evaluation {

struct known_visibility {
    std::string reference;       // id
    std::array<numbers, 4> of{}; // visibility at each receiver for each colour of light

    const numbers& operator[](colour c) const { return of[static_cast<std::size_t>(c)]; }
};

known_visibility filtered_visibility(const translucent_view& view, const texel_stacks& stacks,
                                     std::span<const float> taps);

known_visibility traced_visibility(const translucent_view& view);

} // namespace gnomon::evaluation
