// Ids of surfaces: triangles that cannot shadow one another share an id, as those of a plane and those of a convex part
// do (Palmer 2011, 2.3.2). A receiver ignores all ranges of its own id, so such an id keeps a merged range from
// shadowing any part of its own surface.
#pragma once

#include "moving_scene.hpp"

#include <cstdint>
#include <vector>

namespace gnomon::renderer {

// For each triangle, counted through all meshes, the number of the first triangle of its surface. Triangles are of one
// surface where edges connect them and all of them stay in one plane, or where they are all of a closed part that stays
// convex: at shutter open, at close and halfway. Parts of more than 20,000 triangles count as not convex, since the
// proof takes time in the square of that.
std::vector<std::uint32_t> surface_ids(const moving_scene& world);

} // namespace gnomon::renderer
