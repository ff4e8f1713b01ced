// What shadow maps of translucent occluders are made of: depths of opaque surfaces, and fragments of translucent ones.
#pragma once

#include "evaluation/core/depth_map.hpp"
#include "renderer/raster/fragments.hpp"

#include <gnomon/passes/blend.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace gnomon::evaluation {

// A colour of light. Opacity for grey light is the mean of the other three.
enum class colour { grey, red, green, blue };
inline constexpr std::array<colour, 3> primary_colours{colour::red, colour::green, colour::blue};

float opacity_for(colour of, const glm::vec3& opacity);

// Fragments for one colour of light, from back to front in each texel.
struct coloured_fragments {
    std::vector<translucent_fragment> back_to_front;
    float least_alpha = 1; // of all
    int layers = 0;        // the most in a texel
};

struct translucent_occluders {
    translucent_occluders(const renderer::scene& world, const renderer::camera& light, int resolution);

    // Without the fragments.
    translucent_occluders opaque_alone() const;

    const coloured_fragments& fragments(colour of) const { return fragments_[static_cast<std::size_t>(of)]; }

    depth_map opaque;
    renderer::fragment_map translucent;

  private:
    translucent_occluders() = default;
    std::array<coloured_fragments, 4> fragments_;
};

} // namespace gnomon::evaluation
