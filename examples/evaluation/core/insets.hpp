// The magnified places of a stage's picture.
#pragma once

#include "renderer/output/image.hpp"
#include "renderer/scene/stage.hpp"

#include <glm/vec3.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace gnomon::evaluation {

class magnified_places {
  public:
    // Places of a picture of this size, each a square; all of them together fill the width when they are magnified.
    magnified_places(std::span<const renderer::point_of_interest> places, const renderer::camera& eye, int width,
                     int height);

    std::size_t size() const { return crops_.size(); }
    const renderer::rectangle& crop(std::size_t place) const { return crops_[place]; }
    std::string colour(std::size_t place) const; // "#rrggbb"

    // The picture with the places framed, above the places magnified.
    renderer::picture figure(const renderer::picture& whole) const;

    // The picture with the places framed, above the places of another picture of its size, magnified and with their contrast
    // stretched by a factor about a colour for each.
    renderer::picture figure(const renderer::picture& whole, const renderer::picture& details, float contrast,
                             std::span<const glm::vec3> middles) const;

  private:
    std::vector<renderer::point_of_interest> places_;
    std::vector<renderer::rectangle> crops_;
};

} // namespace gnomon::evaluation
