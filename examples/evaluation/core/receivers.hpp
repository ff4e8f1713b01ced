// The receivers of the renderer, by their own names here.
#pragma once

#include "renderer/shade/receivers.hpp"

namespace gnomon::evaluation {

using renderer::bias_radius;
using renderer::look_up;
using renderer::plane_slope;
using renderer::receivers;
using renderer::receivers_of;
using renderer::steepest_slope;
using renderer::unit_slope;

} // namespace gnomon::evaluation
