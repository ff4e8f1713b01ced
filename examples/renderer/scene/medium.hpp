// A participating medium: air with haze in it, which scatters the light of a directional light once.
#pragma once

#include "camera.hpp"

#include <glm/vec3.hpp>

namespace gnomon::renderer {

// Coefficients per unit of length for red, green and blue light. The density of the medium is exp(-falloff y): it is 1 at
// the height y = 0, and everywhere if there is no falloff.
struct medium {
    glm::vec3 scattering{0}, absorption{0};
    float asymmetry = 0;     // mean cosine of the phase function of Henyey and Greenstein, within (-1, 1)
    glm::vec3 irradiance{1}; // of the light, on a surface across its direction; nothing attenuates it on its way
    float falloff = 0;       // per unit of height

    glm::vec3 extinction() const { return scattering + absorption; }

    // The mean of the extinction of red, green and blue light.
    float mean_extinction() const;

    // The integral of the density over the first `length` of a ray of unit direction. The length may be infinite.
    double thickness(const view_ray& ray, double length) const;

    // The share of scattered light per solid angle that leaves at an angle of this cosine to its former direction.
    double phase(double cosine) const;
};

} // namespace gnomon::renderer
