// A rasterizer for motion on the CPU. The result is a list of depth-time ranges for each texel of a shadow map: what
// the texel sees of a moving scene while the shutter is open, exact by edge functions in time
// (motion/triangle/moving_triangle.h). Parallel over tiles; results do not depend on the number of threads.
//
// Work grows with the texels that are covered, not with the bounding boxes of motion: triangles are tested against
// tiles, then against blocks of 4 x 4 texels, then against texels, by one kernel in space and time
// (motion/triangle/triangle_setup.h), a pack at a time. A tile fills the lists of one pack of texels after the other,
// and resolves lists early that would exceed their memory. The lists of a tile are copied to their place in the map
// once, while they are still in a cache.
#pragma once

#include "rasterizer.hpp"
#include "renderer/scene/moving_scene.hpp"

#include <gnomon/motion/receiver/line_sample.h>
#include <gnomon/passes/range/map.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace gnomon::renderer {

struct range_options {
    faces visible = faces::both;
    bool resolved = false;     // lists hold the ranges in front, without overlaps in time
    bool backdrops = true;     // resolved lists keep a range that is behind all others at all times and shadows nothing
    float depth_tolerance = 0; // the most by which the line of a range departs from depth; 0: one line, however far
    float joining = 0;         // joined ranges of one mesh are behind them by this at most (passes/range/join.hpp)
    std::size_t budget = std::size_t(1) << 14; // ranges of a pack of texels beyond which its lists are resolved early
    // Ranges along a line through each texel at one instant: their times are places on the line. None: ranges in time.
    std::optional<line_sample<double>> line{};
};

// The work of a rasterization.
struct range_counts {
    std::size_t pairs = 0;          // pairs of a texel and a facing of a triangle that covers it at some time
    std::size_t tested = 0;         // tests of a texel against a triangle
    std::size_t early_resolves = 0; // packs of texels that were resolved early, since their budget was used up

    range_counts& operator+=(const range_counts& other)
    {
        pairs += other.pairs, tested += other.tested, early_resolves += other.early_resolves;
        return *this;
    }
};

struct range_lists {
    int width = 0, height = 0;
    std::vector<std::uint32_t> first; // see range_map
    std::vector<depth_time_range<float>> ranges;
    range_counts counts;

    range_map<float> map() const { return {std::size_t(width), std::size_t(height), first, ranges}; }
    std::size_t bytes() const;
};

// The rasterizer keeps its memory from picture to picture.
class range_rasterizer {
  public:
    range_rasterizer();
    ~range_rasterizer();

    // The lists of a scene, valid until the next call. Ids are the numbers of triangles, counted through all meshes.
    // Parts of triangles in front of the near plane are left out.
    const range_lists& operator()(const moving_scene& world, const moving_camera& eye, int width, int height,
                                  const range_options& how = {});

  private:
    struct scratch;
    std::unique_ptr<scratch> scratch_;
    range_lists lists_;
};

// A triangle by its mesh and its index in that mesh.
struct triangle_place {
    std::uint32_t mesh, triangle;
};
// Conversion from the number of a triangle, counted through all meshes.
class triangle_numbers {
  public:
    explicit triangle_numbers(const scene& world);
    triangle_place operator[](std::uint32_t number) const;
    std::uint32_t count() const { return begins_.back(); }

  private:
    std::vector<std::uint32_t> begins_; // the first number of each mesh, and the number of all triangles
};

} // namespace gnomon::renderer
