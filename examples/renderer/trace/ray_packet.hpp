// Packets of rays, for the tracer alone.
#pragma once

#include "embree.hpp"
#include "renderer/scene/scene.hpp"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace gnomon::renderer {

// The number of rays in a packet: those of one receiver or pixel at many times, which are coherent.
inline constexpr int packet = 16;

// Random bits of sample i of an owner, by the finalizer of SplitMix64.
inline std::uint64_t random_bits(std::size_t owner, int i)
{
    std::uint64_t bits = (static_cast<std::uint64_t>(owner) << 24) + static_cast<std::uint64_t>(i) + 1;
    bits *= 0x9e3779b97f4a7c15u;
    bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
    bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
    return bits ^ (bits >> 31);
}

// A time in part i of n.
inline float random_time(std::size_t owner, int i, int n)
{
    const auto jitter = static_cast<float>(random_bits(owner, i) >> 40) * 0x1p-24f;
    return (static_cast<float>(i) + jitter) / static_cast<float>(n);
}

// A place in [0, 1)^2: part i of n along x, and along y a scrambled van der Corput sequence. Of n = 4^k places, each of
// 2^k x 2^k equal squares holds one, and so do all other equal rectangles of this area whose sides are powers of two.
inline glm::dvec2 stratified_place(std::size_t owner, int i, int n)
{
    std::uint32_t reversed = 0;
    for (int bit = 0; bit < 32; ++bit) reversed |= (static_cast<std::uint32_t>(i) >> bit & 1u) << (31 - bit);
    const auto scramble = static_cast<std::uint32_t>(random_bits(owner, -1));
    const auto below = static_cast<double>(random_bits(owner, i) >> 11) * 0x1p-53;
    return {(i + below) / n, (reversed ^ scramble) * 0x1p-32};
}

using mask = std::array<int, packet>; // -1 for rays that are to be traced

struct segment {
    glm::vec3 origin, direction;
    float end;
};

inline constexpr float endless = std::numeric_limits<float>::infinity();

// True if a part of the segment lies within `margin` of the box: the three slabs overlap.
inline bool crosses(const segment& ray, const bounds& box, float margin)
{
    float enter = 0, leave = ray.end;
    for (int i = 0; i < 3; ++i) {
        const float a = (box.lower[i] - margin - ray.origin[i]) / ray.direction[i];
        const float b = (box.upper[i] + margin - ray.origin[i]) / ray.direction[i];
        enter = std::max(enter, std::min(a, b)), leave = std::min(leave, std::max(a, b));
    }
    return enter <= leave;
}

inline void set_ray(RTCRay16& rays, int lane, const segment& ray, float time)
{
    rays.org_x[lane] = ray.origin.x, rays.org_y[lane] = ray.origin.y, rays.org_z[lane] = ray.origin.z;
    rays.dir_x[lane] = ray.direction.x, rays.dir_y[lane] = ray.direction.y, rays.dir_z[lane] = ray.direction.z;
    rays.tnear[lane] = 0, rays.tfar[lane] = ray.end;
    rays.time[lane] = time, rays.mask[lane] = ~0u, rays.id[lane] = static_cast<unsigned>(lane), rays.flags[lane] = 0;
}

} // namespace gnomon::renderer
