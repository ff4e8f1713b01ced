// The curves of Hong & Oh 2017: memory and time of shadow maps of ranges, against the number of random cubes at one
// speed, and against their speed at one number.
#pragma once

#include <nlohmann/json.hpp>
#include <span>

namespace gnomon::demo {

struct cube_case {
    int count;
    float factor; // of the motion
};

// {"resolution": n, "longest": way at factor 1, "rows": [{"count": n, "factor": x, "triangles": n, "pairs": n,
// "pixel_time": texels covered, summed over triangles and the shutter, "maps": [{"method": s, "format": s, "bytes": n,
// "build_ms": x, "ns_per_pair": x, "ranges": n, "covers": n}]}]}
nlohmann::json cube_curves(std::span<const cube_case> cases, int resolution);

// By number at factor 1, and by factor at 400 cubes.
std::span<const cube_case> cube_cases();

} // namespace gnomon::demo
