#include "insets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace gnomon::evaluation {

using namespace renderer;

namespace {

constexpr int gap = 4, magnification = 4;

} // namespace

magnified_places::magnified_places(std::span<const point_of_interest> places, const camera& eye, int width, int height)
    : places_(places.begin(), places.end())
{
    const int count = std::max(static_cast<int>(places.size()), 1);
    const int size = (width - (count - 1) * gap) / (count * magnification);
    for (const point_of_interest& place : places) crops_.push_back(inset_around(place, eye, size, width, height));
}

std::string magnified_places::colour(std::size_t place) const
{
    const glm::vec3& c = places_[place].colour;
    return fmt::format("#{:02x}{:02x}{:02x}", srgb8(c.r), srgb8(c.g), srgb8(c.b));
}

picture magnified_places::figure(const picture& whole) const
{
    return figure(whole, whole, 1, std::vector<glm::vec3>(crops_.size(), glm::vec3(0)));
}

picture magnified_places::figure(const picture& whole, const picture& details, float contrast,
                                 std::span<const glm::vec3> middles) const
{
    if (crops_.empty()) return whole;
    picture framed = whole;
    std::vector<picture> magnified;
    for (std::size_t i = 0; i < crops_.size(); ++i) {
        outline(framed, crops_[i], places_[i].colour);
        picture inset = magnify(details, crops_[i], magnification);
        if (contrast > 1)
            for (glm::vec3& c : inset.pixels) c = middles[i] + contrast * (c - middles[i]);
        outline(inset, {4, 4, inset.width - 8, inset.height - 8}, places_[i].colour, 4);
        magnified.push_back(std::move(inset));
    }
    return stacked(std::array{framed, side_by_side(magnified)});
}

} // namespace gnomon::evaluation
