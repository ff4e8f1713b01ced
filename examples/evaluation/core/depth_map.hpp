// The source of shadow maps: four depths per texel, from a rasterizer with four samples.
#pragma once

#include "renderer/output/image.hpp"

#include <array>

namespace gnomon::evaluation {

using depth_map = renderer::image<std::array<float, 4>>;

} // namespace gnomon::evaluation
