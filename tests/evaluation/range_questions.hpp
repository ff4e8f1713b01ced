// Shared by tests of maps of ranges: a scene of cubes, its exact ranges, and random texels and times of a map.
#pragma once

#include "evaluation/motion/map_source.hpp"
#include "renderer/scene/moving_stages.hpp"
#include "support/effort.hpp"
#include "support/hostile.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace gnomon::test {

using range = depth_time_range<float>;

inline constexpr int resolution = 128;

inline const renderer::moving_stage& cubes()
{
    static const renderer::moving_stage stage = renderer::random_cubes(1, 400, 1);
    return stage;
}

// The map of a method, of the cubes or of another scene.
inline evaluation::range_shadow_map built(const char* method, const evaluation::parameters& how = {},
                                          const renderer::moving_stage& stage = cubes(), int texels = resolution)
{
    return *evaluation::map_source(stage.world, stage.light, texels).map(method, how);
}

inline const evaluation::range_shadow_map& exact()
{
    static const evaluation::range_shadow_map map = built("exact_ranges");
    return map;
}

inline float front(std::span<const range> list, float t)
{
    float nearest = 2;
    for (const range& r : list)
        if (r.t0 <= t && t < r.t1) nearest = std::min(nearest, range_depth(r, t));
    return nearest;
}

inline float intensity(std::span<const range> list, float t, float z, float id)
{
    float result = 0;
    for (const range& r : list) result = std::max(result, range_intensity(r, t, z, id, 0.f));
    return result;
}

struct question {
    std::size_t x, y;
    float t;
};

template <class Ask> void ask(std::uint64_t seed, const Ask& visit)
{
    bit_source bits(seed);
    for (std::int64_t i = 0, n = effort(20'000); i < n; ++i) {
        const std::size_t x = bits.below(resolution), y = bits.below(resolution);
        visit(question{x, y, static_cast<float>(bits.uniform(0, 1))}, bits);
    }
}

inline bool equal(const range& r, const range& s)
{
    return r.t0 == s.t0 && r.t1 == s.t1 && r.z0 == s.z0 && r.z1 == s.z1 && r.id == s.id;
}

} // namespace gnomon::test
