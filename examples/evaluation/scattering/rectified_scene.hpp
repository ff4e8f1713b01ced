// A scene in rectified coordinates: the frame and the rows of the map, its texels from the shadow map, and the exact answer of
// its filters. Methods over rectified maps share it.
#pragma once

#include "view_rays.hpp"

#include <gnomon/passes/rectified_map.hpp>
#include <gnomon/passes/rectify.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace gnomon::evaluation {

inline const registered<map_kind> rectified_kind{
    map_kind{.id = "rectified", .label = "rectified map of prefix averages", .order = 60}};

// The source of a texel: one texel of the shadow map, 4 x 4 texels, or a filtered sample of a map of four moments.
enum class rectified_source { texel, texels, moments };

struct rectified_options {
    rectified_source source = rectified_source::texels;
    rectified_depth depth = rectified_depth::cosine;
    bool range_per_row = true; // of polar angles; else the range of the whole view frustum, as in the paper
    bool fitted = false;       // radii end at the farthest visible surface; else at the far plane
};

// The setting of the paper.
constexpr rectified_options paper_options(rectified_source source) { return {source, rectified_depth::polar, false}; }

// An id of the weights that exact() applies.
std::string id_of(const rectified_options& options);

// The end of a view ray, or of a pack of them, in a rectified map.
template <class Real> struct rectified_end {
    rectified_position<Real> position;
    Real level;
};
using rectified_ray = rectified_end<float>;

class rectified_scene {
  public:
    rectified_scene(const scattering_scene& scene, const rectified_options& options);

    // Fills the map with texels of the format.
    template <class Format> void rectify(map_view<format_texel<Format>> map) const
    {
        const row_range all{0, map.height};
        if (options_.source == rectified_source::texel)
            gnomon::rectify<Format>(scene_.depths.plain(), scene_.map, frame, rows, map, all);
        else if (options_.source == rectified_source::texels)
            rectify_filtered<Format>(scene_.depths.plain(), scene_.map, frame, rows, map, all);
        else rectify_moments<Format, moments4_unorm16>(scene_.depths.filtered(), scene_.map, frame, rows, map, all);
    }

    template <class Real> rectified_end<Real> ray(const view_rays<Real>& to) const
    {
        const auto position = rectified_from_position(to.x, to.y, to.z);
        // Averages over rows alone are wanted, but a level averages over columns as well: never over more than the ray crosses.
        const Real rows_of_pixel = to.footprint / (position.radius * Real(row_angle_));
        return {position, rectified_level(gnomon_min(position.radius / Real(column_width_), rows_of_pixel))};
    }

    // Visibilities of view rays by the exact count of occluders in double, under the weights of the filters.
    std::vector<float> exact(std::span<const view_segment> where) const;

    const std::size_t columns;
    rectified_frame frame;
    std::vector<rectified_row> rows;

  private:
    scattering_scene scene_;
    rectified_options options_;
    float row_angle_, column_width_;
};

} // namespace gnomon::evaluation
