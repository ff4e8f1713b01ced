// A rasterizer for motion on the CPU: what each texel of a shadow map sees of a moving scene while the shutter is open,
// as lists of depth-time ranges, exact by edge functions in time (motion/triangle/moving_triangle.h). Parallel over tiles; its
// results do not depend on the number of threads.
//
// Work grows with what is covered, not with bounding boxes of what moves: triangles are tested against tiles, against
// blocks of 4 x 4 texels and then against texels, by one kernel in space and time (motion/triangle/triangle_setup.h), a pack at a
// time. A tile goes through its blocks and keeps their ranges by packs, counted for each texel; where they would take
// more memory than they may have they are resolved early. Then each goes to its place in the map, once, from a cache.
#pragma once

#include "rasterizer.hpp"
#include "renderer/scene/moving_scene.hpp"

#include <gnomon/passes/range/map.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace gnomon::renderer {

struct range_options {
    faces visible = faces::both;
    bool resolved = false;     // lists of what is in front, without overlaps
    bool backdrops = true;     // resolved lists keep what is behind all else at all times, though it shadows nothing
    float depth_tolerance = 0; // no line is further from depth than this; 0: one line
    float joining = 0; // resolved ranges of one mesh become one that is behind them by no more than this (join.hpp)
    std::size_t budget = std::size_t(1) << 14; // ranges that a pack of texels has room for before it resolves them
};

// What rasterization took.
struct range_counts {
    std::size_t pairs = 0;          // of a texel and a triangle that covers it at some time, for either facing
    std::size_t tested = 0;         // texels tested against triangles
    std::size_t early_resolves = 0; // of packs of texels, since their budget was used up

    range_counts& operator+=(const range_counts& other)
    {
        pairs += other.pairs, tested += other.tested, early_resolves += other.early_resolves;
        return *this;
    }
};

struct range_lists {
    int width = 0, height = 0;
    std::vector<std::uint32_t> first; // as in range_map
    std::vector<depth_time_range<float>> ranges;
    range_counts counts;

    range_map<float> map() const { return {std::size_t(width), std::size_t(height), first, ranges}; }
    std::size_t bytes() const;
};

// Keeps its memory from picture to picture.
class range_rasterizer {
  public:
    range_rasterizer();
    ~range_rasterizer();

    // Ids are the triangles' numbers, counted through all meshes. What is in front of the near plane is not there.
    // The lists are those of the last call.
    const range_lists& operator()(const moving_scene& world, const moving_camera& eye, int width, int height,
                                  const range_options& how = {});

  private:
    struct scratch;
    std::unique_ptr<scratch> scratch_;
    range_lists lists_;
};

// Stochastic rasterization: for each texel as many samples, each at one time, in a stratum of the shutter interval of
// its own. Sample k of texel i is element i samples + k, a range of no duration with the depth and the id of the
// nearest triangle at that time; depth 1 where there is none.
std::vector<depth_time_range<float>> rasterize_instants(const moving_scene& world, const moving_camera& eye, int width,
                                                        int height, int samples);

// The mesh and the triangle in it with this number.
struct triangle_place {
    std::uint32_t mesh, triangle;
};
class triangle_numbers {
  public:
    explicit triangle_numbers(const scene& world);
    triangle_place operator[](std::uint32_t number) const;
    std::uint32_t count() const { return begins_.back(); }

  private:
    std::vector<std::uint32_t> begins_; // of each mesh, and the end
};

} // namespace gnomon::renderer
