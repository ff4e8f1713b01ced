// The costs of maps of ranges of the meshes that people have: animated models and finely tessellated cloth,
// beside cubes.
#pragma once

#include "motion_comparison.hpp"

#include <nlohmann/json.hpp>

namespace gnomon::evaluation {

// [{"scene": s, "resolution": n, "triangles": n, "pairs": n, "tested": n, "accumulation_ms": x, the time of 16 shadow
// maps, "maps": [{"method": s, "ranges": n, "bytes": n, "build_ms": x, "ns_per_pair": x}]}]; times are of building and
// resolving together. Models are those of Debian's assimp-testmodels; where they are absent a line of progress says so.
nlohmann::json mesh_costs(const motion_sizes& size);

} // namespace gnomon::evaluation
