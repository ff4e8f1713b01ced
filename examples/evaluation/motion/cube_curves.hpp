// The curves of Hong & Oh 2017: memory and time of shadow maps of ranges, against the number of random cubes at one
// speed, and against their speed at one number, for small cubes and for large ones.
#pragma once

#include <nlohmann/json.hpp>

#include <span>

namespace gnomon::evaluation {

struct cube_case {
    int count;
    float factor;               // of the motion
    float half_extent = 0.125f; // of a cube
};

// {"count": n, "factor": x, "half_extent": x, "triangles": n, "pairs": n, "pixel_time": texels covered, summed over
// triangles and the shutter, "maps": [{"method": s, "format": s, "bytes": n, "building_bytes": n, "build_ms": x,
// "ns_per_pair": x, "ranges": n, "covers": n}]}; bytes are of the map that look-ups read, building_bytes of what prisms
// need by formula (2) of the paper, and else 0.
nlohmann::json cube_costs(const cube_case& at, int resolution);

inline constexpr float longest_way = 0.5f; // of a cube at factor 1

// By number at factor 1, by factor at 400 cubes, and by factor at 400 large cubes.
std::span<const cube_case> cube_cases();

} // namespace gnomon::evaluation
