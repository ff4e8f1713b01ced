// Memory and time of every map of ranges that has a curve, of random cubes (Hong & Oh 2017): of a number of them, a
// speed and a size.
#pragma once

#include "motion_method.hpp"

#include <cstddef>
#include <vector>

namespace gnomon::evaluation {

struct cube_case {
    int count;
    float speed;
    float half_extent = 0.125f; // of a cube
};

struct map_costs {
    const motion_method* method;
    map_facts facts;
    double ns_per_pair; // of the time to build, for each texel and triangle that covers it at some time
};

struct cube_costs {
    cube_case at;
    std::size_t triangles, pairs;
    std::vector<map_costs> maps;
};

inline constexpr float longest_path = 0.5f; // of a cube at speed 1

cube_costs costs_of(const cube_case& at, int resolution);

} // namespace gnomon::evaluation
