#include "medium.hpp"

#include <glm/gtc/constants.hpp>

#include <cmath>

namespace gnomon::renderer {

float medium::mean_extinction() const
{
    const glm::vec3 sum = extinction();
    return (sum.x + sum.y + sum.z) / 3;
}

double medium::thickness(const view_ray& ray, double length) const
{
    const double growth = -static_cast<double>(falloff) * ray.direction.y; // of the logarithm of the density
    const double along = growth == 0 ? length : std::expm1(growth * length) / growth;
    return std::exp(-static_cast<double>(falloff) * ray.origin.y) * along;
}

double medium::phase(double cosine) const
{
    const double g = static_cast<double>(asymmetry), d = 1 + g * g - 2 * g * cosine;
    return (1 - g * g) / (4 * glm::pi<double>() * d * std::sqrt(d));
}

} // namespace gnomon::renderer
